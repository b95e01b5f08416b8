// The state of shipped scenes after some steps is what it was when these numbers were written down.
//
// They are in tests/data/pinned_hashes.csv, which scripts/test-architectures reads, too. They come
// from programs built for Release before the code that is tested was written (02e1fc1; of `impulse`
// where bodies push each other or meet static ones, 2438df7), and not from that code:
//
//   collisionStress --headless --scene S --law L --precision P --resolver sequential
//                   --partitioner semi-static-quadtree --frames N --json -      (state_hash)
//
// All other tests of bits compare one way to compute a step with another one. A change of the last
// bit that all ways share, in a rule or by a compiler's option, shows only here. Whoever changes
// the physics on purpose writes new numbers, and says so in the changelog.

#include "pinned_hashes.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/support.hpp"

namespace quadrille {
namespace {

std::vector<PinnedHash> pinned() {
    return pinnedHashes(QUADRILLE_TEST_DATA_DIR "/pinned_hashes.csv");
}

class PinnedHashes : public testing::TestWithParam<PinnedHash> {};

TEST_P(PinnedHashes, AreThoseOfTheProgramBefore) {
    const PinnedHash& p = GetParam();
    Scene scene = shippedScene(p.scene);
    Simulation sim(std::move(scene.world), {.partitioner = SemiStaticQuadtree{},
                                            .law = p.law,
                                            .precision = p.precision,
                                            .resolver = ResolverKind::Sequential,
                                            .step = scene.step});
    sim.run(p.frames);
    std::ostringstream hash;
    hash << std::hex << std::setw(16) << std::setfill('0') << stateHash(sim.world());
    EXPECT_EQ(hash.str(), p.hash);
}

TEST(PinnedHashesFile, HasEveryLawInEachPrecision) {
    for (const auto& law : laws()) {
        for (const auto& precision : precisions()) {
            const auto rows = pinned();
            EXPECT_TRUE(std::ranges::any_of(rows,
                                            [&](const PinnedHash& p) {
                                                return p.law == law.kind &&
                                                       p.precision == precision.kind;
                                            }))
                << law.name << ", " << precision.name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PinnedHashes, testing::ValuesIn(pinned()), [](const auto& test) {
    const PinnedHash& p = test.param;
    std::string text =
        p.scene + '_' + std::string(name(p.law)) + '_' + std::string(name(p.precision));
    std::erase(text, '-');
    return text;
});

}  // namespace
}  // namespace quadrille
