#include "app/window/phase_history.hpp"

#include <gtest/gtest.h>
#include <set>
#include <string>

namespace quadrille::app {
namespace {

TEST(PhaseHistory, KeepsTheLastPictures) {
    PhaseHistory history;
    for (std::size_t i = 0; i < PhaseHistory::length + 3; ++i) {
        PhaseHistory::Row row{};
        row[0] = float(i);
        history.add(row);
    }
    ASSERT_EQ(history.size(), PhaseHistory::length);
    EXPECT_EQ(history[0][0], 3);
    EXPECT_EQ(history[PhaseHistory::length - 1][0], float(PhaseHistory::length + 2));
    EXPECT_FLOAT_EQ(history.mean()[0], float(PhaseHistory::length - 1) / 2 + 3);
}

TEST(PhaseHistory, EveryRowHasItsOwnWords) {
    std::set<std::string> names;
    for (std::size_t row = 0; row < PhaseHistory::rows; ++row) {
        const std::string name = phaseWords(row);
        EXPECT_EQ(name.find('_'), std::string::npos) << name;
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_NE(std::string(phaseMeaning(row)), "");
    }
}

TEST(PhaseHistory, HidesWhatCannotOccur) {
    const auto row = [](Phase phase) { return static_cast<std::size_t>(phase); };
    for (const Phase phase : {Phase::Flatten, Phase::CopyToDevice, Phase::CopyToHost}) {
        EXPECT_FALSE(canOccur(row(phase), ResolverKind::Sequential, false));
        EXPECT_FALSE(canOccur(row(phase), ResolverKind::Threads, false));
        EXPECT_TRUE(canOccur(row(phase), ResolverKind::Cuda, false));
    }
    EXPECT_TRUE(canOccur(row(Phase::Resolve), ResolverKind::Sequential, false));
    EXPECT_FALSE(canOccur(PhaseHistory::Error, ResolverKind::Sequential, false));
    EXPECT_TRUE(canOccur(PhaseHistory::Error, ResolverKind::Sequential, true));
    EXPECT_TRUE(canOccur(PhaseHistory::Unaccounted, ResolverKind::Sequential, false));
}

TEST(PhaseHistory, WaitingIsNoWork) {
    EXPECT_FALSE(isWork(PhaseHistory::Present));
    EXPECT_FALSE(isWork(PhaseHistory::Wait));
    EXPECT_TRUE(isWork(PhaseHistory::Unaccounted));
}

}  // namespace
}  // namespace quadrille::app
