#include "app/window/comparison_layout.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

double right(const ScreenRect& rect) { return rect.x + rect.width; }
double bottom(const ScreenRect& rect) { return rect.y + rect.height; }

void expectParts(const ComparisonLayout& layout, const ScreenRect& area) {
    for (const ScreenRect& part :
         {layout.names[0], layout.names[1], layout.views[0], layout.views[1], layout.strip}) {
        EXPECT_GE(part.x, area.x);
        EXPECT_GE(part.y, area.y);
        EXPECT_LE(right(part), right(area) + 1e-9);
        EXPECT_LE(bottom(part), bottom(area) + 1e-9);
        EXPECT_GE(part.width, 1);
        EXPECT_GE(part.height, 1);
    }
    for (int run = 0; run < 2; ++run) {
        EXPECT_EQ(bottom(layout.names[run]), layout.views[run].y);
        EXPECT_LE(bottom(layout.views[run]), layout.strip.y + 1e-9);
    }
    // The same camera shows the same in both.
    EXPECT_EQ(layout.views[0].width, layout.views[1].width);
    EXPECT_EQ(layout.views[0].height, layout.views[1].height);
}

TEST(ComparisonLayout, AWorldAsHighAsWideStandsBesideTheOther) {
    const ScreenRect area{300, 0, 980, 720};
    const ComparisonLayout layout = layOutComparison(area, {100, 100}, 1);
    expectParts(layout, area);
    EXPECT_GE(layout.views[1].x, right(layout.views[0]));
    EXPECT_EQ(layout.views[1].y, layout.views[0].y);
    EXPECT_NEAR(bottom(layout.strip), 720, 1e-9);
}

TEST(ComparisonLayout, AFlatWorldStandsAboveTheOther) {
    const ScreenRect area{0, 0, 1280, 720};
    const ComparisonLayout layout = layOutComparison(area, {2400, 300}, 2);
    expectParts(layout, area);
    EXPECT_EQ(layout.views[0].x, layout.views[1].x);
    EXPECT_GE(layout.names[1].y, bottom(layout.views[0]));
}

TEST(ComparisonLayout, ThereAreViewsInTheSmallestWindow) {
    const ComparisonLayout layout = layOutComparison({300, 0, 1, 64}, {100, 100}, 3);
    EXPECT_GE(layout.views[0].width, 1);
    EXPECT_GE(layout.views[1].height, 1);
}

}  // namespace
}  // namespace quadrille::app
