#include <cstdint>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "core/snapshot_stream.hpp"
#include "core/world_access.hpp"
#include "sanitized.hpp"
#include "support.hpp"

#if __has_include(<sys/resource.h>)
#include <csignal>
#include <sys/resource.h>
#endif

namespace quadrille {
namespace {

SimulationConfig configOf(Precision precision) {
    return {.precision = precision,
            .step = {.dt = 1.0 / 50, .gravity = {3, -100}, .restitution = 0.75}};
}

/// A world with all that a snapshot keeps: several sizes and masses, gaps, names, colours, and
/// entities that are no bodies.
World richWorld(std::uint64_t seed) {
    World world = crowd(seed, 200);
    for (std::uint32_t i = 10; i < 150; i += 7) world.destroy(world.at(i));
    world.flush();
    for (std::uint32_t i = 4; i < 150; i += 5) {
        const Entity entity = world.at(i);
        if (!world.alive(entity)) continue;
        world.set(entity, BoxCollider{{2.0 + i % 3, 3}});
        world.set(entity, RectangleRenderer{{static_cast<std::uint8_t>(i), 2, 3, 4}});
    }
    const Entity heavy = makeBody(world, {0.1, 0.2}, {.velocity = {1, 2}, .mass = 7.5});
    world.add(heavy, Name{"heavy"});
    const Entity marker = world.create("marker");
    world.add(marker, Transform{{1.5, 2.5}}, BoxCollider{{3, 4}});
    world.add(world.create("still"), PhysicsBody{.velocity = {5, 6}, .mass = 7});
    return world;
}

class Snapshots : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& name = "run.snapshot") const {
        return folder_.path() / name;
    }
    /// The bytes of a snapshot of a few bodies.
    std::string smallSnapshot() const {
        const Simulation sim(crowd(1, 5));
        saveSnapshot(file("small"), sim, "small", 1);
        return contentOf(file("small"));
    }
    /// What loading these bytes throws, or nothing.
    std::string errorOfLoading(const std::string& bytes) const {
        const auto path = folder_.write("bytes", bytes);
        return errorOf<SnapshotError>([&] { loadSnapshot(path); });
    }
    std::size_t filesInFolder() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
    }

    TemporaryFolder folder_;
};

class SnapshotsInPrecision : public Snapshots, public testing::WithParamInterface<Precision> {
  protected:
    Simulation resume(const std::filesystem::path& path) const {
        Snapshot snapshot = loadSnapshot(path);
        EXPECT_EQ(snapshot.world.precision(), GetParam());
        Simulation sim(std::move(snapshot.world),
                       {.law = snapshot.law, .precision = GetParam(), .step = snapshot.step});
        sim.resumeAt(snapshot.stepsDone);
        return sim;
    }
};
INSTANTIATE_TEST_SUITE_P(Precisions, SnapshotsInPrecision,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& instance) { return std::string(name(instance.param)); });

// ---- the run goes on

TEST_P(SnapshotsInPrecision, RunGoesOnWithTheSameBits) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Simulation sim(richWorld(seed), configOf(GetParam()));
        Simulation undisturbed(richWorld(seed), configOf(GetParam()));
        sim.run(25);
        saveSnapshot(file(), sim, "rich", seed);
        Simulation resumed = resume(file());
        EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
        sim.run(25);
        resumed.run(25);
        undisturbed.run(50);
        EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
        EXPECT_EQ(stateHash(undisturbed.world()), stateHash(sim.world()));
        EXPECT_EQ(resumed.stepsDone(), 50u);
        EXPECT_EQ(resumed.time(), sim.time());
    }
}

void expectSameEntities(World& is, World& expected) {
    ASSERT_EQ(is.entityCount(), expected.entityCount());
    for (std::uint32_t i = 0; i < 250; ++i) {
        SCOPED_TRACE("entity " + std::to_string(i));
        const Entity e = expected.at(i);
        ASSERT_EQ(is.at(i), e);
        EXPECT_EQ(is.name(e), expected.name(e));
        ASSERT_EQ(is.has<Transform>(e), expected.has<Transform>(e));
        ASSERT_EQ(is.has<BoxCollider>(e), expected.has<BoxCollider>(e));
        ASSERT_EQ(is.has<PhysicsBody>(e), expected.has<PhysicsBody>(e));
        ASSERT_EQ(is.has<RectangleRenderer>(e), expected.has<RectangleRenderer>(e));
        if (is.has<Transform>(e)) {
            EXPECT_EQ(is.get<Transform>(e).position, expected.get<Transform>(e).position);
        }
        if (is.has<BoxCollider>(e)) {
            EXPECT_EQ(is.get<BoxCollider>(e).size, expected.get<BoxCollider>(e).size);
        }
        if (is.has<PhysicsBody>(e)) {
            EXPECT_EQ(is.get<PhysicsBody>(e).velocity, expected.get<PhysicsBody>(e).velocity);
            EXPECT_EQ(is.get<PhysicsBody>(e).mass, expected.get<PhysicsBody>(e).mass);
            EXPECT_EQ(is.get<PhysicsBody>(e).isStatic, expected.get<PhysicsBody>(e).isStatic);
        }
        if (is.has<RectangleRenderer>(e)) {
            EXPECT_EQ(is.get<RectangleRenderer>(e).color, expected.get<RectangleRenderer>(e).color);
        }
    }
}

TEST_P(SnapshotsInPrecision, EntitiesComponentsAndNamesComeBack) {
    Simulation sim(richWorld(4), configOf(GetParam()));
    sim.run(3);
    saveSnapshot(file(), sim, "rich", 4);
    Simulation resumed = resume(file());
    expectSameEntities(resumed.world(), sim.world());
    EXPECT_TRUE(resumed.world().isBody(resumed.world().find("heavy")));
    const Entity marker = resumed.world().find("marker");
    EXPECT_EQ(resumed.world().get<BoxCollider>(marker).size, Vec2(3, 4));
    EXPECT_FALSE(resumed.world().has<PhysicsBody>(marker));
}

/// What a program that makes and destroys bodies by the world's random numbers does.
void churn(World& world, int rounds) {
    for (int i = 0; i < rounds; ++i) {
        const Entity victim = world.at(static_cast<std::uint32_t>(world.random().integer(4, 150)));
        if (world.alive(victim)) world.destroy(victim);
        if (i % 3 == 0) world.flush();
        makeBody(world, {world.random().uniform(-90, 90), 0}, {.velocity = {0, 9}});
    }
}

TEST_P(SnapshotsInPrecision, NewEntitiesGetTheSameIdsAndRandomNumbersGoOn) {
    Simulation sim(richWorld(5), configOf(GetParam()));
    churn(sim.world(), 40);
    sim.step();
    saveSnapshot(file(), sim, "rich", 5);
    Simulation resumed = resume(file());
    churn(sim.world(), 40);
    churn(resumed.world(), 40);
    sim.step();
    resumed.step();
    expectSameEntities(resumed.world(), sim.world());
    EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
}

TEST_P(SnapshotsInPrecision, EntitiesDestroyedJustBeforeStayDestroyed) {
    Simulation sim(richWorld(6), configOf(GetParam()));
    sim.run(2);
    const Entity heavy = sim.world().find("heavy");
    const Entity marker = sim.world().find("marker");
    sim.world().destroy(heavy);
    sim.world().destroy(marker);
    saveSnapshot(file(), sim, "rich", 6);
    Simulation resumed = resume(file());
    EXPECT_FALSE(resumed.world().alive(heavy));
    EXPECT_FALSE(resumed.world().alive(marker));
    sim.step();
    resumed.step();
    EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
    EXPECT_EQ(resumed.world().entityCount(), sim.world().entityCount());
    EXPECT_EQ(resumed.world().create(), sim.world().create());
    EXPECT_EQ(resumed.world().create(), sim.world().create());
}

TEST_P(SnapshotsInPrecision, TheOrderOfCreationComesBack) {
    // Rows in another order, of which some were taken out since: numbers with gaps.
    const auto reversed = [](std::size_t rows) {
        std::vector<std::uint32_t> order(rows);
        for (std::size_t i = 0; i < rows; ++i) order[i] = static_cast<std::uint32_t>(rows - 1 - i);
        return order;
    };
    World world = richWorld(7);
    WorldAccess::permute(world, reversed(world.movingCount()), reversed(world.staticCount()));
    for (const std::uint32_t index : {30u, 41u, 62u}) {
        if (world.alive(world.at(index))) world.destroy(world.at(index));
    }
    world.flush();
    Simulation sim(std::move(world), configOf(GetParam()));
    sim.run(5);
    saveSnapshot(file(), sim, "rich", 7);
    Simulation resumed = resume(file());
    // A body more: it must come last in both.
    for (Simulation* s : {&sim, &resumed}) makeBody(s->world(), {3, 3}, {.velocity = {9, 9}});
    const auto numbers = [](const World& w) {
        return w.visitBodies([](const auto& bodies) {
            EXPECT_FALSE(bodies.moving.created.isRowOrder());
            std::vector<std::uint32_t> result;
            for (std::size_t i = 0; i < bodies.moving.size(); ++i) {
                result.push_back(bodies.moving.created[i]);
            }
            return result;
        });
    };
    EXPECT_EQ(numbers(resumed.world()), numbers(sim.world()));
    sim.run(15);
    resumed.run(15);
    EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
}

TEST_F(Snapshots, SettingsComeBack) {
    Simulation sim(crowd(), {.law = Law::Baseline,
                             .step = {.dt = 0.1, .gravity = {0.3, -1e-9}, .restitution = 1.0 / 3}});
    sim.run(3);
    saveSnapshot(file(), sim, "a scene, \"quoted\"", 0xffff'ffff'ffff'ffffu);
    const Snapshot snapshot = loadSnapshot(file());
    EXPECT_EQ(snapshot.scene, "a scene, \"quoted\"");
    EXPECT_EQ(snapshot.seed, 0xffff'ffff'ffff'ffffu);
    EXPECT_EQ(snapshot.stepsDone, 3u);
    EXPECT_EQ(snapshot.law, Law::Baseline);
    EXPECT_EQ(snapshot.step.dt, 0.1);
    EXPECT_EQ(snapshot.step.gravity, Vec2(0.3, -1e-9));
    EXPECT_EQ(snapshot.step.restitution, 1.0 / 3);
    EXPECT_EQ(snapshot.world.config().size, Vec2(200, 200));
    EXPECT_EQ(snapshot.world.config().seed, 1u);
}

TEST_F(Snapshots, EmptyWorldComesBack) {
    saveSnapshot(file(), Simulation(World{}), "", 0);
    EXPECT_EQ(loadSnapshot(file()).world.entityCount(), 0u);
}

// ---- files that are refused

TEST_F(Snapshots, DamageOfASingleByteIsRefused) {
    const std::string good = smallSnapshot();
    ASSERT_EQ(errorOfLoading(good), "");
    for (std::size_t at = 0; at < good.size(); at += at < 200 || at + 200 > good.size() ? 1 : 13) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ (1 << at % 8));
        ASSERT_NE(errorOfLoading(bad), "") << "byte " << at;
    }
}

TEST_F(Snapshots, MissingEndIsRefused) {
    const std::string good = smallSnapshot();
    for (std::size_t size = 0; size < good.size(); size += size < 50 ? 1 : 37) {
        ASSERT_NE(errorOfLoading(good.substr(0, size)), "") << "size " << size;
    }
    EXPECT_NE(errorOfLoading(good.substr(0, good.size() - 1)), "");
    EXPECT_NE(errorOfLoading(good + '\0'), "");
    EXPECT_NE(errorOfLoading(good + good), "");
}

TEST_F(Snapshots, OtherFilesAreRefusedByName) {
    for (const std::string& bytes :
         {std::string(), std::string("x"), std::string(8, '\0'),
          std::string("format = 1\n[world]\nsize = [1, 1]\n"), std::string(100'000, 'x')}) {
        const std::string error = errorOfLoading(bytes);
        EXPECT_NE(error.find(file("bytes").string()), std::string::npos) << error;
    }
    const std::string error = errorOf<SnapshotError>([&] { loadSnapshot(file("missing")); });
    EXPECT_NE(error.find("missing"), std::string::npos) << error;
    EXPECT_THROW(loadSnapshot(folder_.path()), SnapshotError);
}

/// The bytes with a checksum that fits them.
std::string sealed(std::string bytes) {
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    Checksum checksum;
    checksum.add(bytes.data(), bytes.size());
    std::uint64_t sum = checksum.value();
    toFileOrder(sum);
    return bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

TEST_F(Snapshots, OtherProgramVersionOrByteOrderIsRefusedEvenWithAFittingChecksum) {
    const std::string good = smallSnapshot();
    ASSERT_EQ(errorOfLoading(sealed(good)), "");
    const std::size_t magic = good.find('\n') + 1;
    std::string bad = good;
    bad[0] = 'q';
    EXPECT_NE(errorOfLoading(sealed(bad)), "");
    bad = good;
    bad[magic] = static_cast<char>(bad[magic] + 1);
    EXPECT_NE(errorOfLoading(sealed(bad)), "");
    bad = good;
    std::swap(bad[magic + 4], bad[magic + 7]);
    std::swap(bad[magic + 5], bad[magic + 6]);
    EXPECT_NE(errorOfLoading(sealed(bad)), "");
}

TEST_F(Snapshots, MissingAndSurplusDataAreRefusedEvenWithAFittingChecksum) {
    const std::string good = smallSnapshot();
    for (std::size_t size = sizeof(std::uint64_t); size < good.size(); size += 37) {
        ASSERT_NE(errorOfLoading(sealed(good.substr(0, size))), "") << "size " << size;
    }
    EXPECT_NE(errorOfLoading(sealed(good + '\0')), "");
}

// ---- files that cannot be written

TEST_F(Snapshots, AnotherSnapshotReplacesTheFile) {
    folder_.write("run.snapshot", "old");
    saveSnapshot(file(), Simulation(crowd()), "new", 1);
    EXPECT_EQ(loadSnapshot(file()).scene, "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(Snapshots, FailureToOpenLeavesNothing) {
    const Simulation sim(crowd());
    const auto target = file("no folder") / "run.snapshot";
    const std::string error = errorOf([&] { saveSnapshot(target, sim, "", 1); });
    EXPECT_NE(error.find(target.string()), std::string::npos) << error;
    EXPECT_EQ(filesInFolder(), 0u);
}

// A law may leave the numbers that there are in the last step: a snapshot of that could not be
// read.
TEST_F(Snapshots, AnUnsoundWorldDoesNotReplaceTheFileOfASoundOne) {
    Simulation sim(crowd());
    saveSnapshot(file(), sim, "sound", 1);
    sim.world().editBodies([](const auto& bodies) {
        using Real = std::remove_cvref_t<decltype(bodies.moving.vx[0])>;
        bodies.moving.vx[0] = static_cast<Real>(infinity);
    });
    const std::string error = errorOf([&] { saveSnapshot(file(), sim, "unsound", 1); });
    EXPECT_NE(error.find("velocity is not finite"), std::string::npos) << error;
    EXPECT_EQ(loadSnapshot(file()).scene, "sound");
}

// Numbers that a double has and a float has not: refused when the file is read, not when a run
// begins.
TEST_F(Snapshots, SettingsThatTheirPrecisionDoesNotHaveAreRefused) {
    for (const StepSettings& step : {StepSettings{.dt = 1e-60}, StepSettings{.dt = 1e300},
                                     StepSettings{.gravity = {0, -1e300}}}) {
        saveSnapshot(file(), Simulation(crowd(1, 5), {.step = step}), "", 1);
        EXPECT_EQ(errorOfLoading(contentOf(file())), "");
        World world = crowd(1, 5);
        Simulation single(std::move(world), {.precision = Precision::Float});
        saveSnapshot(file(), single, "", 1);
        std::string bytes = contentOf(file());
        // After the magic, version, byte order, scene, seed, steps and law.
        const std::size_t at = bytes.find('\n') + 1 + 4 + 4 + 8 + 8 + 8 + 1;
        const double values[] = {step.dt, step.gravity.x(), step.gravity.y()};
        std::memcpy(bytes.data() + at, values, sizeof values);
        EXPECT_NE(errorOfLoading(sealed(bytes)).find("single precision"), std::string::npos);
    }
}

TEST_F(Snapshots, FailureToTakeTheNameLeavesNoPart) {
    std::filesystem::create_directories(file() / "occupied");
    EXPECT_THROW(saveSnapshot(file(), Simulation(crowd()), "", 1), Error);
    EXPECT_TRUE(std::filesystem::is_directory(file() / "occupied"));
    EXPECT_EQ(filesInFolder(), 1u);
}

#ifdef RLIMIT_FSIZE
/// Less of what the system gives, such as the size of a file, which is like a full disk.
class ResourceLimit {
  public:
    using Resource = decltype(RLIMIT_FSIZE);

    ResourceLimit(Resource resource, rlim_t limit)
        : resource_(resource), handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(resource_, &before_);
        const rlimit lower{limit, before_.rlim_max};
        setrlimit(resource_, &lower);
    }
    ~ResourceLimit() {
        setrlimit(resource_, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    ResourceLimit(const ResourceLimit&) = delete;
    ResourceLimit& operator=(const ResourceLimit&) = delete;

  private:
    Resource resource_;
    rlimit before_{};
    void (*handler_)(int);
};

TEST_F(Snapshots, FailureToOpenLeavesTheOldFileAsItWas) {
    if (sanitized) GTEST_SKIP() << "a check of dynamic types needs a descriptor of its own";
    const Simulation sim(crowd());
    folder_.write("run.snapshot", "old");
    std::string error;
    {
        const ResourceLimit limit(RLIMIT_NOFILE, 0);
        error = errorOf([&] { saveSnapshot(file(), sim, "", 1); });
    }
    EXPECT_NE(error.find(file().string()), std::string::npos) << error;
    EXPECT_EQ(contentOf(file()), "old");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(Snapshots, FailureToWriteLeavesTheOldFileAsItWasAndNoPart) {
    const Simulation sim(crowd());
    for (const rlim_t size : {rlim_t(0), rlim_t(1), rlim_t(9000)}) {
        folder_.write("run.snapshot", "old");
        std::string error;
        {
            const ResourceLimit limit(RLIMIT_FSIZE, size);
            error = errorOf([&] { saveSnapshot(file(), sim, "", 1); });
        }
        EXPECT_NE(error.find(file().string()), std::string::npos) << error;
        EXPECT_EQ(contentOf(file()), "old");
        EXPECT_EQ(filesInFolder(), 1u);
    }
}
#endif

}  // namespace
}  // namespace quadrille
