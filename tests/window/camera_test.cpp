#include "app/window/camera.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

const ScreenRect view{300, 0, 980, 720};

TEST(Camera, ShowsItsCentreInTheMiddleAndTheWorldUpwards) {
    Camera camera;
    camera.center = Vec2(10, 20);
    EXPECT_EQ(camera.toScreen({10, 20}, view), Vec2(790, 360));
    EXPECT_EQ(camera.toScreen({13, 25}, view), Vec2(793, 355));
}

TEST(Camera, FromTheScreenAndBackIsTheSamePlace) {
    Camera camera;
    camera.center = Vec2(-7, 3);
    camera.zoomAt({500, 100}, 2.5, view);
    const Vec2 place(123.5, 77.25);
    EXPECT_LT((camera.toScreen(camera.toWorld(place, view), view) - place).norm(), 1e-9);
}

TEST(Camera, ZoomKeepsWhatIsUnderTheCursor) {
    const Vec2 cursor(1000, 50);
    for (const double factor : {1.15, 8.0, 0.01, 1e-300, 1e300}) {
        Camera camera;
        const Vec2 before = camera.toWorld(cursor, view);
        camera.zoomAt(cursor, factor, view);
        EXPECT_LT((camera.toWorld(cursor, view) - before).norm() * camera.zoom(), 1e-6) << factor;
        EXPECT_GE(camera.zoom(), 1e-7);
        EXPECT_LE(camera.zoom(), 1e5);
    }
}

TEST(Camera, PanMovesThePicture) {
    Camera camera;
    camera.zoomAt({0, 0}, 4, view);
    const Vec2 before = camera.toScreen({5, 6}, view);
    camera.pan({30, -12});
    EXPECT_LT((camera.toScreen({5, 6}, view) - before - Vec2(30, -12)).norm(), 1e-9);
}

TEST(Camera, FitShowsAllOfAPart) {
    Camera camera;
    for (const Vec2& size : {Vec2(100, 10), Vec2(3, 4000)}) {
        const Bounds part{Vec2(50, 60), Vec2(50, 60) + size};
        camera.fit(part, view);
        EXPECT_TRUE(view.contains(camera.toScreen(part.low, view)));
        EXPECT_TRUE(view.contains(camera.toScreen(part.high, view)));
        // And no smaller than it must be.
        const Vec2 shown = size * camera.zoom();
        EXPECT_GT(std::max(shown.x() / view.width, shown.y() / view.height), 0.95);
    }
}

}  // namespace
}  // namespace quadrille::app
