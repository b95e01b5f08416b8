// Every kind has one name, and every name one kind.

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <string_view>
#include <variant>

#include <quadrille/names.hpp>

namespace quadrille {
namespace {

template <class Kind>
void expectNamesBothWays(std::span<const Named<Kind>> all) {
    std::set<std::string_view> names;
    for (const Named<Kind>& named : all) {
        SCOPED_TRACE(named.name);
        EXPECT_FALSE(named.name.empty());
        EXPECT_FALSE(named.about.empty());
        EXPECT_TRUE(names.insert(named.name).second) << "another one has the name";
        EXPECT_EQ(name(named.kind), named.name);
        const auto found = find(all, named.name);
        ASSERT_TRUE(found.has_value());
        if constexpr (requires { found->index(); }) {
            EXPECT_EQ(found->index(), named.kind.index());
        } else {
            EXPECT_EQ(*found, named.kind);
        }
        EXPECT_FALSE(find(all, std::string(named.name) + "x").has_value());
        EXPECT_FALSE(find(all, named.name.substr(1)).has_value());
    }
    EXPECT_FALSE(find(all, "").has_value());
}

TEST(Names, LeadBothWays) {
    expectNamesBothWays(laws());
    expectNamesBothWays(resolvers());
    expectNamesBothWays(precisions());
    expectNamesBothWays(partitioners());
}

TEST(Names, CoverEveryKind) {
    EXPECT_EQ(laws().size(), 3u);
    EXPECT_EQ(resolvers().size(), 5u);
    EXPECT_EQ(precisions().size(), 2u);
    EXPECT_EQ(partitioners().size(), std::variant_size_v<PartitionerConfig>);
    for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
        EXPECT_NE(name(law), "");
    }
    for (const ResolverKind resolver :
         {ResolverKind::Auto, ResolverKind::Sequential, ResolverKind::Threads, ResolverKind::Cuda,
          ResolverKind::CudaResident}) {
        EXPECT_NE(name(resolver), "");
    }
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        EXPECT_NE(name(precision), "");
    }
}

// Files and scripts hold them.
TEST(Names, AreThoseOfTheCommandLine) {
    EXPECT_EQ(name(Law::Baseline), "baseline");
    EXPECT_EQ(name(Law::Impulse), "impulse");
    EXPECT_EQ(name(Law::Continuous), "continuous");
    EXPECT_EQ(name(ResolverKind::Auto), "auto");
    EXPECT_EQ(name(ResolverKind::Sequential), "sequential");
    EXPECT_EQ(name(ResolverKind::Threads), "threads");
    EXPECT_EQ(name(ResolverKind::Cuda), "cuda");
    EXPECT_EQ(name(ResolverKind::CudaResident), "cuda-resident");
    EXPECT_EQ(name(Precision::Double), "double");
    EXPECT_EQ(name(Precision::Float), "float");
    EXPECT_EQ(name(BruteForce{}), "brute-force");
    EXPECT_EQ(name(StaticGrid{{1, 2}}), "static-grid");
    EXPECT_EQ(name(Quadtree{1, 2}), "quadtree");
    EXPECT_EQ(name(SemiStaticQuadtree{1, 2}), "semi-static-quadtree");
}

TEST(Names, OfThePhasesAreAllDifferent) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < phaseCount; ++i) names.insert(name(static_cast<Phase>(i)));
    EXPECT_EQ(names.size(), phaseCount);
    EXPECT_EQ(name(Phase::Integrate), "integrate");
    EXPECT_EQ(name(Phase::CopyToDevice), "copy_to_device");
    EXPECT_EQ(name(Phase::Observe), "observe");
}

}  // namespace
}  // namespace quadrille
