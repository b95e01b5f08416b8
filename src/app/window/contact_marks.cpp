#include "app/window/contact_marks.hpp"

#include <algorithm>
#include <cmath>

#include "app/window/nice_numbers.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

/// Half of the line of an impulse at the end of the scale: half of the boxes' shorter sides, in
/// these bounds, points. Small boxes have small marks, or these would hide them.
constexpr double shortestLine = 4, longestLine = 30;

struct Mark {
    Vec2 low, high;  // what the sides share, on the screen
    Vec2 impulse;    // kg px/s
    Axis axis;
    bool collided;
};

struct Box {
    Vec2 low, high;
};

std::optional<Box> boxOf(const World& world, Entity entity) {
    if (!world.alive(entity) || !world.isBody(entity)) return std::nullopt;
    const Vec2 position = world.get<Transform>(entity).position;
    const Vec2 half = world.get<BoxCollider>(entity).size / 2;
    return Box{position - half, position + half};
}

ImVec2 point(const Vec2& p) { return {float(p.x()), float(p.y())}; }

}  // namespace

std::optional<LengthKey> drawContactMarks(ImDrawList& list, const World& world,
                                          const std::vector<Contact>& contacts,
                                          std::optional<Entity> only, const Camera& camera,
                                          const ScreenRect& view, double scale) {
    std::vector<Mark> marks;
    std::vector<float> impulses;
    double sides = 0;  // sum of the shorter sides, points
    for (const Contact& contact : contacts) {
        if (only && contact.a != *only && contact.b != *only) continue;
        const auto a = boxOf(world, contact.a), b = boxOf(world, contact.b);
        if (!a || !b) continue;
        // What the boxes share, or the gap that they have left since.
        const Vec2 first = a->low.cwiseMax(b->low), second = a->high.cwiseMin(b->high);
        const Vec2 p = camera.toScreen(first.cwiseMin(second), view);
        const Vec2 q = camera.toScreen(first.cwiseMax(second), view);
        if (!view.contains((p + q) / 2)) continue;
        marks.push_back(
            {p.cwiseMin(q), p.cwiseMax(q), contact.impulse, contact.axis, contact.collided});
        if (contact.collided) impulses.push_back(float(contact.impulse.norm()));
        sides +=
            camera.zoom() * std::min((a->high - a->low).minCoeff(), (b->high - b->low).minCoeff());
    }
    if (marks.empty()) return std::nullopt;
    const double top = niceCeiling(percentile(impulses, 0.95));
    const double side = sides / double(marks.size());
    const double half = std::clamp(side / 2, shortestLine * scale, longestLine * scale);
    const ImU32 collided = packed(theme.collided), touching = packed(theme.touching);
    const double line = std::round(std::clamp(side / 8, scale, 2 * scale));
    const auto thickness = static_cast<float>(line);
    const Vec2 dot = Vec2(1.25, 1.25) * line;
    for (const Mark& mark : marks) {
        const ImU32 color = mark.collided ? collided : touching;
        const Vec2 middle = (mark.low + mark.high) / 2;
        // The sides that meet lie across the axis; at a corner there are none.
        if (mark.axis == Axis::X) {
            list.AddLine(point({middle.x(), mark.low.y()}), point({middle.x(), mark.high.y()}),
                         color, thickness);
        } else if (mark.axis == Axis::Y) {
            list.AddLine(point({mark.low.x(), middle.y()}), point({mark.high.x(), middle.y()}),
                         color, thickness);
        }
        for (int axis = 0; axis < 2 && mark.collided && top > 0; ++axis) {
            if (!(mark.impulse[axis] > 0)) continue;
            Vec2 along(0, 0);
            along[axis] = half * std::min(mark.impulse[axis] / top, 1.0);
            list.AddLine(point(middle - along), point(middle + along), color, thickness);
        }
        list.AddRectFilled(point(middle - dot), point(middle + dot), color);
    }
    if (top == 0) return std::nullopt;
    return LengthKey{"impulse of a contact", collided, 2 * half, compact(top) + " kg px/s"};
}

}  // namespace quadrille::app
