// Snapshots that earlier programs wrote are read, and runs go on from them with the same bits.
//
// tests/data/snapshots has, for each version of the format that can be read, each law and
// precision, a run after 30 steps and the same run after 60. A file that reads back what the same
// program wrote shows no change that both share: of the layout, of the checksum, of the byte order.
// These show it.
//
// After a new format version, this writes its files, which go beside those of the versions before:
//
//   QUADRILLE_WRITE_SNAPSHOTS=1 quadrille_core_tests --gtest_filter='*StoredSnapshots*'

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>

#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "core/snapshot_stream.hpp"
#include "support.hpp"

namespace quadrille {
namespace {

constexpr int newestVersion = 4;
constexpr int versions[] = {newestVersion};

class StoredSnapshots : public testing::TestWithParam<std::tuple<Law, Precision>> {
  protected:
    Law law() const { return std::get<Law>(GetParam()); }
    Precision precision() const { return std::get<Precision>(GetParam()); }

    std::filesystem::path stored(int version, int steps) const {
        const std::string file = "v" + std::to_string(version) + "-" + std::string(name(law())) +
                                 "-" + std::string(name(precision())) + "-" + std::to_string(steps);
        return std::filesystem::path(QUADRILLE_TEST_DATA_DIR) / "snapshots" / (file + ".snapshot");
    }

    /// All that a snapshot keeps, in few bodies: sizes and masses that differ, one that rests,
    /// names, colours, gaps, an entity that is no body.
    Simulation start() const {
        World world = crowd(3, 24);
        for (std::uint32_t i = 6; i < 24; i += 7) world.destroy(world.at(i));
        world.flush();
        for (std::uint32_t i = 5; i < 24; i += 5) {
            if (!world.alive(world.at(i))) continue;
            world.set(world.at(i), BoxCollider{{2.0 + i % 3, 3}});
            world.set(world.at(i), RectangleRenderer{{static_cast<std::uint8_t>(i), 2, 3, 4}});
        }
        const Entity heavy = makeBody(world, {0.1, 0.2}, {.velocity = {1, 2}, .mass = 7.1});
        world.add(heavy, Name{"heavy"});
        makeBody(world, {40, -97.99}, {});
        world.add(world.create("marker"), Transform{{1.5, 2.5}}, BoxCollider{{3, 4}});
        return Simulation(std::move(world),
                          {.law = law(),
                           .precision = precision(),
                           .resolver = ResolverKind::Sequential,
                           .step = {.dt = 1.0 / 50, .gravity = {3, -100}, .restitution = 0.7}});
    }

    void expectStored(const Simulation& sim, int steps) const {
        const auto file = stored(newestVersion, steps);
        const auto written = folder_.path() / "written";
        saveSnapshot(written, sim, "stored", 3);
        if (std::getenv("QUADRILLE_WRITE_SNAPSHOTS") != nullptr) {
            std::filesystem::copy_file(written, file,
                                       std::filesystem::copy_options::overwrite_existing);
        }
        // Not EXPECT_EQ, which would print both.
        EXPECT_TRUE(contentOf(written) == contentOf(file)) << file << ": other bytes";
        EXPECT_EQ(stateHash(sim.world()), stateHash(loadSnapshot(file).world));
    }

    TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Laws, StoredSnapshots,
                         testing::Combine(testing::Values(Law::Baseline, Law::Impulse,
                                                          Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         lawInPrecision);

TEST_P(StoredSnapshots, AreWrittenWithTheSameBytes) {
    Simulation sim = start();
    sim.run(30);
    expectStored(sim, 30);
}

TEST_P(StoredSnapshots, GoOn) {
    for (const int version : versions) {
        Snapshot snapshot = loadSnapshot(stored(version, 30));
        EXPECT_EQ(snapshot.scene, "stored");
        EXPECT_EQ(snapshot.seed, 3u);
        EXPECT_EQ(snapshot.stepsDone, 30u);
        EXPECT_EQ(snapshot.law, law());
        EXPECT_EQ(snapshot.world.precision(), precision());
        EXPECT_EQ(snapshot.step.gravity, Vec2(3, -100));
        EXPECT_EQ(snapshot.step.restitution, 0.7);
        EXPECT_TRUE(snapshot.world.isBody(snapshot.world.find("heavy")));
        Simulation sim(std::move(snapshot.world), {.law = snapshot.law,
                                                   .precision = precision(),
                                                   .resolver = ResolverKind::Sequential,
                                                   .step = snapshot.step});
        sim.resumeAt(snapshot.stepsDone);
        sim.run(30);
        expectStored(sim, 60);
    }
}

// The checksum is that of the format: another one, or one that spares some bytes, reads what it
// wrote itself but not these.
TEST_P(StoredSnapshots, AreNotTakenWithAChangeOfAnyOfTheirLastBytes) {
    const std::string good = contentOf(stored(newestVersion, 30));
    ASSERT_GT(good.size(), 40u);
    for (std::size_t at = good.size() - 40; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 1);
        const std::string error =
            errorOf<SnapshotError>([&] { loadSnapshot(folder_.write("bad", bad)); });
        EXPECT_NE(error.find("is damaged"), std::string::npos) << "byte " << at << ": " << error;
    }
}

// The values that its authors give (Fowler, Noll & Vo, draft-eastlake-fnv, appendix C).
TEST(ChecksumOfSnapshots, IsFnv1a) {
    const auto of = [](const std::string& text) {
        Checksum checksum;
        checksum.add(text.data(), text.size());
        return checksum.value();
    };
    EXPECT_EQ(of(""), 0xcbf29ce484222325u);
    EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(of("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace quadrille
