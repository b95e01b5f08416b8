#include "app/window/hit_times.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

TEST(HitTimes, AreOfTheLastContactThatCollided) {
    HitTimes times;
    EXPECT_EQ(times.last(3), HitTimes::never);
    Contact contact;
    contact.a = {3, 0};
    contact.b = {70, 0};
    contact.time = 1.5;
    times.record(contact);
    EXPECT_EQ(times.last(3), HitTimes::never) << "it only touched";
    contact.collided = true;
    times.record(contact);
    EXPECT_EQ(times.last(3), 1.5);
    EXPECT_EQ(times.last(70), 1.5);
    EXPECT_EQ(times.last(4), HitTimes::never);
    contact.b = {4, 0};
    contact.time = 2;
    times.record(contact);
    EXPECT_EQ(times.last(3), 2);
    EXPECT_EQ(times.last(70), 1.5);
    times.clear();
    EXPECT_EQ(times.last(3), HitTimes::never);
}

}  // namespace
}  // namespace quadrille::app
