#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "program.hpp"

namespace quadrille {
namespace {

class Dump : public ProgramTest {};

const Arguments imbalanced = {"--headless", "--scene", "imbalanced", "--frames", "30"};

Simulation imbalancedRun(Precision precision = Precision::Double) {
    Scene scene = loadScene(shippedScene("imbalanced"));
    return Simulation(std::move(scene.world), {.precision = precision, .step = scene.step});
}

template <class Real>
void expectSameState(const Table& table, World& world) {
    ASSERT_EQ(table.columns, (std::vector<std::string>{"entity", "x", "y", "vx", "vy"}));
    const auto m = world.bodies<Real>().moving;
    ASSERT_EQ(table.rows.size(), m.size());
    const auto bits = [](Real value) {
        return std::bit_cast<std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>>(
            value);
    };
    for (std::size_t i = 0; i < m.size(); ++i) {
        const auto& row = table.rows[i];
        ASSERT_EQ(row.size(), 5u);
        ASSERT_EQ(row[0], std::to_string(i));
        const std::array<Real, 4> expected = {m.x[i], m.y[i], m.vx[i], m.vy[i]};
        for (std::size_t k = 0; k < 4; ++k) {
            const std::string& text = row[k + 1];
            Real value = 0;
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            ASSERT_TRUE(error == std::errc() && end == text.data() + text.size()) << text;
            ASSERT_EQ(bits(value), bits(expected[k])) << "row " << i << ": " << text;
            // Shortest: what the standard library makes of the number.
            std::array<char, 32> shortest{};
            const auto written = std::to_chars(shortest.data(), shortest.data() + 32, expected[k]);
            ASSERT_EQ(text, std::string(shortest.data(), written.ptr));
        }
    }
}

TEST_F(Dump, StateReadsBackExactly) {
    const ProcessResult result =
        runProgram(imbalanced + Arguments{"--dump-state", file("state.csv")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(files(), std::vector<std::string>{"state.csv"});
    Simulation sim = imbalancedRun();
    sim.run(30);
    expectSameState<double>(parseTable(contentOf(path("state.csv"))), sim.world());
}

TEST_F(Dump, StateInSinglePrecisionReadsBackExactly) {
    const ProcessResult result =
        runProgram(imbalanced + Arguments{"--precision", "float", "--dump-state", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    Simulation sim = imbalancedRun(Precision::Float);
    sim.run(30);
    expectSameState<float>(parseTable(result.out), sim.world());
}

TEST_F(Dump, EventsAreTheCollisionsOfTheLibrary) {
    const ProcessResult result =
        runProgram(imbalanced + Arguments{"--dump-events", file("events.csv"), "--json", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Table table = parseTable(contentOf(path("events.csv")));
    ASSERT_EQ(table.columns, (std::vector<std::string>{"t", "i", "j", "axis", "impulse_x",
                                                       "impulse_y", "approach_x", "approach_y"}));

    Simulation sim = imbalancedRun();
    std::vector<Contact> collisions;
    std::size_t touches = 0;
    sim.onContact([&](const Contact& contact) {
        ++touches;
        if (contact.collided) collisions.push_back(contact);
    });
    sim.run(30);
    ASSERT_GE(touches, collisions.size());
    ASSERT_EQ(table.rows.size(), collisions.size());
    EXPECT_EQ(parseJson(result.out)["collisions"], collisions.size());
    bool withStatic = false;
    for (std::size_t k = 0; k < collisions.size(); ++k) {
        const auto& row = table.rows[k];
        ASSERT_EQ(row.size(), 8u);
        ASSERT_EQ(numberOf(row[0]), collisions[k].time) << "event " << k;
        ASSERT_EQ(row[1], std::to_string(collisions[k].numberA)) << "event " << k;
        ASSERT_EQ(row[2], std::to_string(collisions[k].numberB)) << "event " << k;
        ASSERT_EQ(row[3], std::to_string(int(collisions[k].axis))) << "event " << k;
        ASSERT_EQ(numberOf(row[4]), collisions[k].impulse.x()) << "event " << k;
        ASSERT_EQ(numberOf(row[5]), collisions[k].impulse.y()) << "event " << k;
        ASSERT_EQ(numberOf(row[6]), collisions[k].approach.x()) << "event " << k;
        ASSERT_EQ(numberOf(row[7]), collisions[k].approach.y()) << "event " << k;
        withStatic = withStatic || collisions[k].numberB < 0;
    }
    EXPECT_TRUE(withStatic);
}

/// Galperin's billiard: the collisions of the masses 1 and 10000 are the digits of pi.
TEST_F(Dump, EventsOfPiAreCounted) {
    const ProcessResult result =
        runProgram({"--headless", "--scene", "pi", "--frames", "200000", "--dump-events", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(parseTable(result.out).rows.size(), 314u);
}

TEST_F(Dump, ListeningChangesNothing) {
    const Json with =
        summaryOf({"--scene", "imbalanced", "--frames", "30", "--dump-events", file("events.csv")});
    const Json without = summaryOf({"--scene", "imbalanced", "--frames", "30"});
    EXPECT_EQ(with["state_hash"], without["state_hash"]);
    EXPECT_EQ(with["collisions"], without["collisions"]);
}

TEST_F(Dump, CsvHasARowAFrame) {
    const ProcessResult result =
        runProgram(imbalanced + Arguments{"--csv", file("frames.csv"), "--json", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json summary = parseJson(result.out);
    const Table table = parseTable(contentOf(path("frames.csv")));
    ASSERT_GE(table.columns.size(), 4u);
    EXPECT_EQ(table.columns[0], "frame");
    ASSERT_EQ(table.rows.size(), 30u);
    std::vector<double> sums(table.columns.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        ASSERT_EQ(table.rows[i].size(), table.columns.size());
        EXPECT_EQ(table.rows[i][0], std::to_string(i + 1));
        for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += numberOf(table.rows[i][c]);
    }
    for (std::size_t c = 0; c < sums.size(); ++c) {
        for (const char* key : {"contacts", "collisions", "pairs_tested"}) {
            if (table.columns[c] == key) {
                EXPECT_EQ(sums[c], summary[key].get<double>()) << key;
            }
        }
        if (table.columns[c] == "rebuilt") {
            EXPECT_EQ(sums[c], summary["rebuilds"].get<double>());
        }
        if (table.columns[c] == "kinetic_energy") {
            EXPECT_EQ(numberOf(table.rows.back()[c]), summary["kinetic_energy"]["end"]);
        }
    }
}

TEST_F(Dump, CsvOnStdoutIsPure) {
    const ProcessResult result = runProgram(imbalanced + Arguments{"--csv", "-"});
    ASSERT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.err, "summary"));
    const Table table = parseTable(result.out);
    ASSERT_EQ(table.rows.size(), 30u);
    for (const auto& row : table.rows) {
        for (const std::string& field : row) numberOf(field);
    }
}

}  // namespace
}  // namespace quadrille
