#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <system_error>
#include <tuple>

#include <quadrille/components.hpp>
#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline Entity makeBody(World& world, const Vec2& position, const PhysicsBody& body = {},
                       const Vec2& size = {2, 4}) {
    const Entity entity = world.create();
    world.add(entity, Transform{position}, BoxCollider{size}, body);
    return entity;
}

/// Boxes of random velocities between four walls, in a world of 200 x 200 px; some overlap.
inline World crowd(std::uint64_t seed = 1, int count = 300) {
    World world({.size = {200, 200}, .seed = seed});
    world.addWalls();
    Random& random = world.random();
    for (int i = 0; i < count; ++i) {
        const Vec2 position(random.uniform(-95, 95), random.uniform(-95, 95));
        const Vec2 velocity(random.uniform(-200, 200), random.uniform(-200, 200));
        makeBody(world, position, {.velocity = velocity}, {4, 4});
    }
    return world;
}

/// What `action` throws as an Expected, or nothing.
template <class Expected = Error, class Action>
std::string errorOf(Action&& action) {
    try {
        action();
    } catch (const Expected& error) {
        return error.what();
    }
    return {};
}

/// How test reports show a precision.
inline void PrintTo(Precision precision, std::ostream* out) { *out << name(precision); }

/// How tests are named that are run with laws in precisions.
inline std::string lawInPrecision(const testing::TestParamInfo<std::tuple<Law, Precision>>& test) {
    const auto [law, precision] = test.param;
    return std::string(name(law)) + "In" + std::string(name(precision));
}

/// A folder of its own that goes away with the object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::random_device random;
        do {
            path_ = std::filesystem::temp_directory_path() /
                    ("quadrille-test-" + std::to_string(random()));
        } while (!std::filesystem::create_directory(path_));
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        const auto file = path_ / name;
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }

  private:
    std::filesystem::path path_;
};

inline std::string contentOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace quadrille
