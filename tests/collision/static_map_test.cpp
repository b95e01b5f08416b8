// The map of static boxes shows every box of a region, and says that nothing is near only where
// nothing is.

#include "collision/static_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "collision/support.hpp"

namespace quadrille {
namespace {

struct Boxes {
    std::vector<double> x, y, halfWidth, halfHeight;

    void add(const Box<double>& b) {
        x.push_back(b.x);
        y.push_back(b.y);
        halfWidth.push_back(b.halfWidth);
        halfHeight.push_back(b.halfHeight);
    }
    BodyView<double> view() const {
        BodyView<double> v;
        v.fixed.x = x;
        v.fixed.y = y;
        v.fixed.halfWidth = halfWidth;
        v.fixed.halfHeight = halfHeight;
        v.moving.halfWidth.common = v.moving.halfHeight.common = 1.5;
        return v;
    }
};

TEST(StaticMap, ShowsWhatIsInARegion) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Boxes boxes;
        const int count = 1 << seed % 9;
        for (int i = 0; i < count; ++i) {
            const double size = i % 7 == 0 ? 200 : 9;
            boxes.add({random.uniform(-300, 300), random.uniform(-200, 200),
                       random.uniform(0.1, size), random.uniform(0.1, size)});
        }
        StaticMap<double> map;
        map.update(boxes.view());
        for (int i = 0; i < 500; ++i) {
            const Box<double> region{random.uniform(-600, 600), random.uniform(-500, 500),
                                     random.uniform(0.5, i % 5 == 0 ? 90 : 3),
                                     random.uniform(0.5, 3)};
            std::vector<double> shown, right;
            map.view().forEachIn(region, [&](const Box<double>& box) { shown.push_back(box.x); });
            for (std::size_t k = 0; k < boxes.x.size(); ++k) {
                const Box<double> box{boxes.x[k], boxes.y[k], boxes.halfWidth[k],
                                      boxes.halfHeight[k]};
                if (overlap(region, box)) right.push_back(box.x);
            }
            std::sort(shown.begin(), shown.end());
            shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
            std::sort(right.begin(), right.end());
            ASSERT_EQ(shown, right);
            found += int(right.size());
            if (map.view().clear(region.x, region.y, region.halfWidth, region.halfHeight)) {
                ASSERT_TRUE(right.empty());
            }
        }
    }
    EXPECT_GT(found, 0);
}

TEST(StaticMap, FollowsAnEdit) {
    Boxes boxes;
    boxes.add({0, 0, 5, 5});
    boxes.add({90, 90, 5, 5});
    StaticMap<double> map;
    map.update(boxes.view());
    const auto countAt = [&](double x) {
        int count = 0;
        map.view().forEachIn({x, 0, 1, 1}, [&](const Box<double>&) { ++count; });
        return count;
    };
    EXPECT_GT(countAt(0), 0);
    EXPECT_EQ(countAt(50), 0);
    EXPECT_TRUE(map.view().clear(50, 0, 1.5, 1.5));
    boxes.x[0] = 50;
    map.update(boxes.view());
    EXPECT_EQ(countAt(0), 0);
    EXPECT_GT(countAt(50), 0);
    EXPECT_FALSE(map.view().clear(50, 0, 1.5, 1.5));
}

TEST(StaticMap, StaysSmallHoweverManyLargeBoxesItHas) {
    Boxes boxes;
    for (int i = 0; i < 20'000; ++i) boxes.add({i * 1e-3, 0, 100, 100});
    StaticMap<double> map;
    map.update(boxes.view());
    EXPECT_LT(map.bytes(), 8u << 20);
}

}  // namespace
}  // namespace quadrille
