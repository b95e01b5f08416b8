// Every kind has one name, and every name one kind.

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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

using Strings = std::vector<std::string>;

Strings nearest(std::string_view typed, const Strings& names) { return nearestNames(typed, names); }

TEST(NearestNames, AreATypingErrorAway) {
    const Strings names = {"precision", "partitioner", "profile", "law"};
    for (const char* typed : {"precision", "presicion", "precison", "precisionn", "prexision",
                              "rpecision", "PRECISION", "Precison"}) {
        EXPECT_EQ(nearest(typed, names), Strings{"precision"}) << typed;
    }
    EXPECT_EQ(nearest("lwa", names), Strings{"law"});
}

/// Two letters that are swapped are one error, and letters that another one parts are two.
TEST(NearestNames, CountASwapOnce) {
    EXPECT_EQ(nearest("abdc", {"abcd"}), Strings{"abcd"});
    EXPECT_EQ(nearest("cba", {"abc"}), Strings{});
    EXPECT_EQ(nearest("cbadef", {"abcdef"}), Strings{"abcdef"});
}

TEST(NearestNames, MissAThirdOfTheLettersAtMost) {
    EXPECT_EQ(nearest("xyzdefghi", {"abcdefghi"}), Strings{"abcdefghi"});
    EXPECT_EQ(nearest("xyzwefghi", {"abcdefghi"}), Strings{});
    EXPECT_EQ(nearest("abcdef", {"abcdefghi"}), Strings{"abcdefghi"});
    EXPECT_EQ(nearest("abcde", {"abcdefghi"}), Strings{});
    EXPECT_EQ(nearest("pj", {"pi"}), Strings{});
    EXPECT_EQ(nearest("pie", {"pi"}), Strings{"pi"});
    EXPECT_EQ(nearest("", {"pi", ""}), Strings{""});
    EXPECT_EQ(nearest(std::string(1 << 20, 'x'), {"pi"}), Strings{});
}

TEST(NearestNames, AreThoseOfTheFewestErrors) {
    EXPECT_EQ(nearest("balancd", {"imbalanced", "balanced", "balance"}),
              (Strings{"balanced", "balance"}));
    EXPECT_EQ(nearest("balaced", {"imbalanced", "balanced", "balance"}), Strings{"balanced"});
    EXPECT_EQ(nearest("boxes", {"box", "bones", "boxer"}), (Strings{"bones", "boxer"}));
}

TEST(NearestNames, MakeAQuestion) {
    EXPECT_EQ(didYouMean({}), "");
    EXPECT_EQ(didYouMean(Strings{"a"}), "; did you mean 'a'?");
    EXPECT_EQ(didYouMean(Strings{"a", "b"}), "; did you mean 'a' or 'b'?");
    EXPECT_EQ(didYouMean(Strings{"a", "b", "c"}), "; did you mean 'a', 'b' or 'c'?");
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
