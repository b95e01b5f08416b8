// The state of shipped scenes after some steps is what it was when these numbers were written down.
//
// They come from the program of version 0.1.0 before its engines had an interface (commit 02e1fc1),
// built for Release, and not from the code that is tested:
//
//   collisionStress --headless --scene S --law L --precision P --resolver sequential
//                   --partitioner semi-static-quadtree --frames N --json -      (state_hash)
//
// All other tests of bits compare one way to compute a step with another one. A change of the last
// bit that all ways share, in a rule or by a compiler's option, shows only here. Whoever changes
// the physics on purpose writes new numbers, and says so in the changelog.

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <utility>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/support.hpp"

namespace quadrille {
namespace {

struct Pinned {
    std::string scene;
    std::uint64_t frames;
    /// In double and in single precision; of baseline, impulse, continuous.
    std::uint64_t hashes[3][2];
};

std::ostream& operator<<(std::ostream& out, const Pinned& p) {
    return out << p.scene << ", " << p.frames << " frames";
}

const Pinned pinned[] = {
    {"bullet",
     3,
     {{0xc5df4b444fcfbc93, 0x63f4e7c47fe8988f},
      {0xc5df4b444fcfbc93, 0x63f4e7c47fe8988f},
      {0xe8668a77f0955493, 0xc56d9cb2897b623f}}},
    {"cradle",
     200,
     {{0xd4c102aaade986ac, 0x3f91ccf819e30c16},
      {0x10fab6730e4467f4, 0xe7fcf16bea1cb54f},
      {0x1c504b0f6dd74b8c, 0x2ed6e95eaf514038}}},
    {"demo13k",
     10,
     {{0x5232f1715aef8ee9, 0xbfd1c4c192f3f71c},
      {0x24fb641dcbc31624, 0x4853d2805e7171b1},
      {0xf8a0fbe442e89116, 0x2fcc7330d4207e74}}},
    {"imbalanced",
     2,
     {{0x2d8b3602043f50ff, 0x5db2cc41f4d51df1},
      {0x4ffe85239d4f56cc, 0xc15d214077d46a53},
      {0x5a6049426be1658c, 0xd95c7d12060767ff}}},
    {"imbalanced-clear",
     3,
     {{0xf52e3eece5d1958d, 0x09da116508403cf2},
      {0x3cbb3dc71a9a1787, 0xfffffdd27c93aabc},
      {0x676c91cae33f9299, 0x0079d9f6e1e2e55f}}},
    {"mixed-sizes",
     10,
     {{0x127f6d149c411deb, 0x282557c09f0f8d70},
      {0x94a51c251845656c, 0xf8fce3a1c3b9e289},
      {0xac58038433634345, 0x450d9a63bc378d1e}}},
    {"pi",
     44000,
     {{0xaea7fdaa3163a911, 0xaf660cc6832631a1},
      {0x071c77eb1a79005f, 0xf27166ac23b1ee12},
      {0xafecb182feb3f42f, 0x8456163cbaa3ac8c}}},
    {"pile",
     18,
     {{0x27bfb83541523c79, 0xa1a8cf52900634a9},
      {0x74f9e017104315b7, 0xc6ccc6bffd1f8b90},
      {0xaa5fbb0252e057c8, 0xb304ffa5a9ffa902}}},
};

class PinnedHashes : public testing::TestWithParam<Pinned> {};

TEST_P(PinnedHashes, AreThoseOfTheProgramBefore) {
    const Pinned& p = GetParam();
    for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
        for (const Precision precision : {Precision::Double, Precision::Float}) {
            Scene scene = shippedScene(p.scene);
            Simulation sim(std::move(scene.world), {.partitioner = SemiStaticQuadtree{},
                                                    .law = law,
                                                    .precision = precision,
                                                    .resolver = ResolverKind::Sequential,
                                                    .step = scene.step});
            sim.run(p.frames);
            const auto& ofLaw = p.hashes[static_cast<std::size_t>(law)];
            EXPECT_EQ(stateHash(sim.world()), ofLaw[static_cast<std::size_t>(precision)])
                << name(law) << ", " << name(precision);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PinnedHashes, testing::ValuesIn(pinned), [](const auto& test) {
    std::string text = test.param.scene;
    std::erase(text, '-');
    return text;
});

}  // namespace
}  // namespace quadrille
