// The store of the bodies: who has the newest state, when an edit counts, and that all columns go
// along wherever rows move.

#include "core/body_store.hpp"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <type_traits>
#include <variant>
#include <vector>

#include "support.hpp"

namespace quadrille {
namespace {

using Order = std::vector<std::uint32_t>;

/// A moving body whose every number tells its entity.
BodyStore::NewBody numbered(std::uint32_t entity, bool isStatic = false) {
    const double n = entity;
    return {.position = {n + 0.125, n + 0.25},
            .halfSize = {n + 1, n + 2},
            .velocity = isStatic ? Vec2(0, 0) : Vec2(n + 0.5, n + 0.625),
            .mass = n + 3,
            .isStatic = isStatic,
            .entity = entity};
}

/// Moving bodies 0 to 5, static ones 10 to 13.
BodyStore numberedStore() {
    BodyStore store;
    for (std::uint32_t i = 0; i < 6; ++i) store.append(numbered(i));
    for (std::uint32_t i = 10; i < 14; ++i) store.append(numbered(i, true));
    return store;
}

/// Fails unless every row has the numbers of its entity, those of the law's columns included.
void expectNumbered(const BodyStore& store, const Order& moving, const Order& fixed) {
    const auto& [m, f] = std::get<BodyStore::Columns<double>>(store.columns());
    ASSERT_EQ(m.size(), moving.size());
    ASSERT_EQ(f.size(), fixed.size());
    for (std::size_t i = 0; i < m.size(); ++i) {
        SCOPED_TRACE("moving row " + std::to_string(i));
        const BodyStore::NewBody is = numbered(m.entity[i]);
        EXPECT_EQ(m.entity[i], moving[i]);
        EXPECT_EQ(Vec2(m.x[i], m.y[i]), is.position);
        EXPECT_EQ(Vec2(m.vx[i], m.vy[i]), is.velocity);
        EXPECT_EQ(Vec2(m.halfWidth[i], m.halfHeight[i]), is.halfSize);
        EXPECT_EQ(m.mass[i], is.mass);
        if (m.anchors.kept()) {
            EXPECT_EQ(m.anchors.stored()[i].timeX, 100 + m.entity[i]);
        }
        if (m.rests.kept()) {
            EXPECT_EQ(m.rests.stored()[i], 50 + m.entity[i]);
        }
    }
    for (std::size_t i = 0; i < f.size(); ++i) {
        SCOPED_TRACE("static row " + std::to_string(i));
        const BodyStore::NewBody is = numbered(f.entity[i], true);
        EXPECT_EQ(f.entity[i], fixed[i]);
        EXPECT_EQ(Vec2(f.x[i], f.y[i]), is.position);
        EXPECT_EQ(Vec2(f.halfWidth[i], f.halfHeight[i]), is.halfSize);
        EXPECT_EQ(f.mass[i], is.mass);
    }
}

/// Writes numbers of the entities to the columns of a law's own.
void numberLawState(BodyStore& store) {
    const auto bodies = store.advance<double>({.anchors = true, .rests = true});
    for (std::size_t i = 0; i < bodies.moving.size(); ++i) {
        bodies.anchors[i].timeX = 100 + bodies.moving.entity[i];
        bodies.rests[i] = static_cast<std::uint8_t>(50 + bodies.moving.entity[i]);
    }
}

Order createdOrder(const CreationOrder& created, std::size_t rows) {
    Order numbers;
    for (std::size_t i = 0; i < rows; ++i) numbers.push_back(created[i]);
    return numbers;
}

// ---- who has the newest state

/// Knows that row 0 has come to x = 77.
struct FakeMirror : BodyMirror {
    int fetched = 0;
    bool lost = false;
    KeptColumns kept{};

    void fetch(BodyStore& store) override {
        ++fetched;
        if (lost) throw DeviceError("lost");
        store.advance<double>(kept).moving.x[0] = 77;
    }
};

/// A store of two bodies whose anchors say more than its columns: they are at x = 10 t and 20 t.
BodyStore movedStore(double gravity = 0) {
    BodyStore store;
    for (std::uint32_t i = 0; i < 2; ++i) store.append(numbered(i));
    const auto bodies =
        store.advance<double>({.anchors = true, .rests = gravity != 0},
                              {.law = Law::Continuous, .gravity = {0, gravity}, .restitution = 1});
    bodies.anchors[0] = {0, 0, 10, 1, 0, 0};
    bodies.anchors[1] = {20, 0, 20, 1, 1, 1};
    return store;
}

TEST(BodyStore, PlacesBodiesWhenSomebodyLooks) {
    const auto expectPlaced = [](auto&& look) {
        BodyStore store = movedStore();
        store.placeLater(3);
        look(store);
        EXPECT_EQ(store.position(BodyRef::moving(0)), Vec2(30, 3));
        EXPECT_EQ(std::get<BodyStore::Columns<double>>(store.columns()).moving.x.view()[1], 60);
    };
    expectPlaced([](BodyStore&) {});
    expectPlaced([](BodyStore& s) { EXPECT_EQ(s.read<double>().moving.x[1], 60); });
    expectPlaced([](BodyStore& s) { s.append(numbered(7)); });
    expectPlaced([](BodyStore& s) { s.permute(Order{0, 1}, Order{}); });
    expectPlaced([](BodyStore& s) { s.setHalfSize(BodyRef::moving(1), {1, 1}); });
    expectPlaced([](BodyStore& s) { s.advance<double>({}); });  // a law without anchors
    expectPlaced([](BodyStore& s) { s.advance<double>({.anchors = true}); });  // other physics
    BodyStore edited = movedStore();
    edited.placeLater(3);
    edited.setPosition(BodyRef::moving(0), {-5, -5});
    EXPECT_EQ(edited.position(BodyRef::moving(0)), Vec2(-5, -5));
    EXPECT_EQ(edited.position(BodyRef::moving(1)), Vec2(60, 2));
}

TEST(BodyStore, PlacesFallingBodiesAndTheirVelocities) {
    BodyStore store = movedStore(-8);
    store.placeLater(3);
    EXPECT_EQ(store.position(BodyRef::moving(0)), Vec2(30, 3 - 36));
    EXPECT_EQ(store.velocity(0), Vec2(10, 1 - 24));
}

TEST(BodyStore, ALawThatKeepsAnchorsGetsThemAsTheyAre) {
    BodyStore store = movedStore();
    const Physics physics = store.physics();
    store.placeLater(3);
    const auto bodies = store.advance<double>({.anchors = true}, physics);
    EXPECT_FALSE(bodies.placed);
    EXPECT_EQ(bodies.moving.x[0], 0.125);
    store.placeLater(4);
    EXPECT_EQ(store.position(BodyRef::moving(0)), Vec2(40, 4));
    EXPECT_TRUE(store.advance<double>({.anchors = true}, physics).placed);
}

TEST(BodyMirror, IsAskedOnceByWhoeverReadsFirst) {
    BodyStore store = numberedStore();
    FakeMirror mirror;
    store.newestIs(&mirror);
    EXPECT_EQ(mirror.fetched, 0);
    const BodyStore& reader = store;
    EXPECT_EQ(reader.read<double>().moving.x[0], 77);
    EXPECT_EQ(reader.position(BodyRef::moving(0)).x(), 77);
    EXPECT_EQ(mirror.fetched, 1) << "what is here already is not asked for again";
    store.newestIs(&mirror);
    reader.read<double>();
    EXPECT_EQ(mirror.fetched, 2);
}

TEST(BodyMirror, IsAskedByEverybodyWhoNeedsTheStateAndByNobodyElse) {
    FakeMirror mirror;
    const auto asks = [&](auto&& action) {
        BodyStore store = numberedStore();
        store.newestIs(&mirror);
        const int before = mirror.fetched;
        action(store);
        return mirror.fetched - before;
    };
    using Store = BodyStore&;
    EXPECT_EQ(asks([](Store s) { s.read<double>(); }), 1);
    EXPECT_EQ(asks([](Store s) { s.edit<double>(); }), 1);
    EXPECT_EQ(asks([](Store s) { s.advance<double>({}); }), 1);
    EXPECT_EQ(asks([](Store s) { s.columns(); }), 1);
    EXPECT_EQ(asks([](Store s) { s.append(numbered(7)); }), 1);
    EXPECT_EQ(asks([](Store s) {
                  s.erase([](std::uint32_t) { return false; }, [](std::uint32_t, BodyRef) {});
              }),
              1);
    EXPECT_EQ(asks([](Store s) { s.eraseRow(BodyRef::moving(1), [](std::uint32_t, BodyRef) {}); }),
              1);
    EXPECT_EQ(asks([](Store s) { s.permute(Order{0, 1, 2, 3, 4, 5}, Order{0, 1, 2, 3}); }), 1);
    EXPECT_EQ(asks([](Store s) { s.position(BodyRef::moving(1)); }), 1);
    EXPECT_EQ(asks([](Store s) { s.velocity(1); }), 1);
    EXPECT_EQ(asks([](Store s) { s.setPosition(BodyRef::moving(1), {0, 0}); }), 1);
    EXPECT_EQ(asks([](Store s) { s.setHalfSize(BodyRef::moving(1), {1, 1}); }), 1);
    EXPECT_EQ(asks([](Store s) { s.setVelocityAndMass(1, {0, 0}, 1); }), 1);
    EXPECT_EQ(asks([](Store s) { s.setPrecision(Precision::Float); }), 1);

    EXPECT_EQ(asks([](Store s) { s.movingCount(); }), 0);
    EXPECT_EQ(asks([](Store s) { s.setPrecision(Precision::Double); }), 0) << "it has it already";
    EXPECT_EQ(asks([](Store s) { s.halfSize(BodyRef::moving(1)); }), 0) << "no step changes it";
    EXPECT_EQ(asks([](Store s) { s.mass(BodyRef::moving(1)); }), 0) << "no step changes it";
    EXPECT_EQ(asks([](Store s) { s.reserve(100); }), 0);
    EXPECT_EQ(asks([](Store s) { s.newestIs(nullptr); }), 0);
    EXPECT_EQ(asks([](Store s) { s.replace(BodyStore::AnyColumns{}, Edits::Everything, {}); }), 0);
}

TEST(BodyMirror, OfAStateThatIsNotWantedIsForgotten) {
    BodyStore store = numberedStore();
    FakeMirror mirror;
    store.newestIs(&mirror);
    store.newestIs(nullptr);
    EXPECT_EQ(store.read<double>().moving.x[0], 0.125);
    store.newestIs(&mirror);
    store.replace(numberedStore().columns(), Edits::Everything, {});
    EXPECT_EQ(store.read<double>().moving.x[0], 0.125);
    EXPECT_EQ(mirror.fetched, 0);
}

TEST(BodyMirror, ThatIsLostIsAnErrorOnceAndLeavesTheLastKnownState) {
    BodyStore store = numberedStore();
    FakeMirror mirror;
    mirror.lost = true;
    store.newestIs(&mirror);
    EXPECT_THROW(store.read<double>(), DeviceError);
    EXPECT_EQ(store.read<double>().moving.x[0], 0.125);
}

TEST(BodyMirror, AndStoreMayEndInAnyOrder) {
    FakeMirror outlives;
    {
        BodyStore store = numberedStore();
        store.newestIs(&outlives);
    }
    BodyStore other = numberedStore();
    {
        FakeMirror ends;
        other.newestIs(&ends);
    }
    EXPECT_EQ(other.read<double>().moving.x[0], 0.125) << "nobody is there to be asked";
    other.newestIs(&outlives);
    EXPECT_EQ(other.read<double>().moving.x[0], 77);
    EXPECT_EQ(outlives.fetched, 1);
}

TEST(BodyMirror, ThatAdvancesTheBodiesIsNewestAndNoEdit) {
    BodyStore store = numberedStore();
    FakeMirror mirror;
    store.advance<double>({.anchors = true, .rests = true});
    const std::uint64_t revision = store.revision();
    const Physics physics{.law = Law::Impulse, .gravity = {0, -5}, .restitution = 0.5};
    store.newestIs(&mirror);
    mirror.kept = {.anchors = true};
    store.advancedBy(mirror, mirror.kept, physics);
    EXPECT_EQ(mirror.fetched, 0) << "an engine that has the bodies needs none";
    EXPECT_EQ(store.revision(), revision);
    EXPECT_EQ(store.edits(), Edits::None);
    EXPECT_EQ(store.physics(), physics);
    EXPECT_EQ(store.read<double>().moving.x[0], 77);
    EXPECT_TRUE(std::get<0>(store.columns()).moving.anchors.kept());
    EXPECT_FALSE(std::get<0>(store.columns()).moving.rests.kept());
}

// ---- edits

TEST(BodyStore, AnEditCountsWhenItEnds) {
    BodyStore store = numberedStore();
    const std::uint64_t before = store.revision();
    {
        const auto edit = store.edit<double>();
        edit->moving.x[2] = 9;
        (*edit).moving.vy[2] = 8;
        EXPECT_EQ(store.revision(), before);
    }
    EXPECT_NE(store.revision(), before);
    EXPECT_EQ(store.read<double>().moving.x[2], 9);
    EXPECT_EQ(store.read<double>().moving.vy[2], 8);
    EXPECT_EQ(store.read<double>().revision, store.revision());
}

TEST(BodyStore, HasARevisionThatNoOtherStoreHas) {
    BodyStore one = numberedStore();
    BodyStore two = numberedStore();
    EXPECT_NE(one.revision(), two.revision());
    one.replace(two.columns(), Edits::None, {});
    EXPECT_NE(one.revision(), two.revision());
}

TEST(BodyStore, ReadingAndAdvancingAreNoEdits) {
    BodyStore store = numberedStore();
    const std::uint64_t before = store.revision();
    store.read<double>();
    store.advance<double>({.anchors = true}).moving.x[0] = 3;
    store.columns();
    store.reserve(50);
    EXPECT_EQ(store.revision(), before);
    EXPECT_EQ(store.read<double>().moving.x[0], 3);
}

TEST(BodyStore, KnowsWhatWasEditedSinceALawAdvancedIt) {
    BodyStore store = numberedStore();
    EXPECT_EQ(store.edits(), Edits::Everything);
    EXPECT_EQ(store.advance<double>({}).edits, Edits::Everything);
    EXPECT_EQ(store.edits(), Edits::None);
    EXPECT_EQ(store.advance<double>({}).edits, Edits::None);
    const auto expectEdits = [&](Edits edits, const char* what, auto&& action) {
        SCOPED_TRACE(what);
        store.advance<double>({});
        const auto revision = store.revision();
        const auto layout = store.layout();
        action();
        EXPECT_NE(store.revision(), revision);
        EXPECT_EQ(store.layout() == layout, edits == Edits::Values);
        EXPECT_EQ(store.read<double>().layout, store.layout());
        EXPECT_EQ(store.edits(), edits);
        EXPECT_EQ(store.advance<double>({}).edits, edits);
    };
    const auto expectAll = [&](const char* what, auto&& action) {
        expectEdits(Edits::Everything, what, action);
        expectEdits(Edits::Everything, what, [&] {
            action();
            store.edit<double>();
        });
    };
    double mass = 100;
    expectAll("append", [&] { store.append(numbered(6)); });
    expectAll("eraseRow",
              [&] { store.eraseRow(BodyRef::fixed(0), [](std::uint32_t, BodyRef) {}); });
    expectAll("erase", [&] {
        store.erase([](std::uint32_t e) { return e == 6; }, [](std::uint32_t, BodyRef) {});
    });
    expectAll("static position", [&] { store.setPosition(BodyRef::fixed(1), {0, 0}); });
    expectAll("size", [&] { store.setHalfSize(BodyRef::moving(1), {1, 1}); });
    expectAll("mass", [&] { store.setVelocityAndMass(1, {0, 0}, ++mass); });
    expectAll("mass of a static body", [&] { store.setStaticMass(1, 2); });
    expectAll("replace", [&] { store.replace(numberedStore().columns(), Edits::Everything, {}); });
    expectEdits(Edits::Values, "edit", [&] { store.edit<double>(); });
    expectEdits(Edits::Values, "position", [&] { store.setPosition(BodyRef::moving(1), {0, 0}); });
    expectEdits(Edits::Values, "velocity", [&] {
        store.setVelocityAndMass(1, {7, 7}, store.mass(BodyRef::moving(1)));
    });
    store.replace(numberedStore().columns(), Edits::None, {});
    EXPECT_EQ(store.edits(), Edits::None) << "a run that is resumed goes on as if nothing happened";
    const std::uint64_t before = store.layout();
    store.permute(Order{1, 0, 2, 3, 4, 5}, Order{0, 1, 2, 3});
    EXPECT_NE(store.layout(), before) << "other bodies are in the rows";
    EXPECT_EQ(store.edits(), Edits::None) << "but nothing has happened to them";
    store.edit<double>();
    store.permute(Order{1, 0, 2, 3, 4, 5}, Order{0, 1, 2, 3});
    EXPECT_EQ(store.edits(), Edits::Values);
}

TEST(BodyStore, CountsOtherPhysicsAsAnEdit) {
    BodyStore store = numberedStore();
    const Physics before{Law::Continuous, {0, -1}, 0.5};
    store.advance<double>({}, before);
    EXPECT_EQ(store.advance<double>({}, before).edits, Edits::None);
    for (const Physics& after :
         {Physics{Law::Impulse, {0, -1}, 0.5}, Physics{Law::Continuous, {1, -1}, 0.5},
          Physics{Law::Continuous, {0, -1}, 0.6}}) {
        EXPECT_EQ(store.advance<double>({}, after).edits, Edits::Everything);
        EXPECT_EQ(store.advance<double>({}, after).edits, Edits::None);
        store.replace(numberedStore().columns(), Edits::None, before);
        EXPECT_EQ(store.advance<double>({}, after).edits, Edits::Everything);
        store.replace(numberedStore().columns(), Edits::None, before);
    }
    EXPECT_EQ(store.advance<double>({}, before).edits, Edits::None);
}

TEST(BodyStore, ARefusedBodyLeavesNothing) {
    BodyStore store = numberedStore();
    store.setPrecision(Precision::Float);
    store.advance<float>({});
    for (const bool isStatic : {false, true}) {
        BodyStore::NewBody bad = numbered(20, isStatic);
        bad.halfSize = {1e-60, 1};
        EXPECT_THROW(store.append(bad), Error);
    }
    BodyStore::NewBody heavy = numbered(20);
    heavy.mass = 1e60;
    EXPECT_THROW(store.append(heavy), Error);
    EXPECT_THROW(store.setVelocityAndMass(0, {0, 1e60}, 1), Error);
    EXPECT_EQ(store.movingCount(), 6u);
    EXPECT_EQ(store.staticCount(), 4u);
    EXPECT_EQ(store.velocity(0), numbered(0).velocity);
    EXPECT_EQ(store.edits(), Edits::None);
}

// ---- the columns of a law's own

TEST(BodyStore, KeepsTheColumnsThatALawAsksFor) {
    BodyStore store = numberedStore();
    EXPECT_TRUE(store.advance<double>({}).anchors.empty());
    auto bodies = store.advance<double>({.anchors = true});
    ASSERT_EQ(bodies.anchors.size(), 6u);
    EXPECT_TRUE(bodies.rests.empty());
    EXPECT_EQ(bodies.plain().moving.anchors, bodies.anchors.data());
    EXPECT_EQ(bodies.plain().moving.rests, nullptr);
    for (const Anchor<double>& anchor : bodies.anchors) {
        EXPECT_NE(anchor.timeX, anchor.timeX) << "unknown";
        EXPECT_NE(anchor.timeY, anchor.timeY) << "unknown";
    }
    bodies.anchors[2].timeX = 5;
    store.append(numbered(6));
    bodies = store.advance<double>({.anchors = true, .rests = true});
    ASSERT_EQ(bodies.anchors.size(), 7u);
    EXPECT_EQ(bodies.anchors[2].timeX, 5);
    EXPECT_NE(bodies.anchors[6].timeX, bodies.anchors[6].timeX) << "a new body's is unknown, too";
    EXPECT_EQ(bodies.rests[6], 0);
    bodies = store.advance<double>({.rests = true});
    EXPECT_TRUE(bodies.anchors.empty());
    bodies = store.advance<double>({.anchors = true});
    EXPECT_NE(bodies.anchors[2].timeX, 5) << "a law that comes back finds nothing of old";
}

TEST(BodyStore, ConversionDropsTheLawsOwnStateAndKeepsTheRest) {
    BodyStore store = numberedStore();
    numberLawState(store);
    store.permute(Order{3, 1, 0, 5, 4, 2}, Order{3, 0, 1, 2});
    store.setPrecision(Precision::Float);
    const auto floats = store.advance<float>({.anchors = true, .rests = true});
    for (const auto& anchor : floats.anchors) EXPECT_NE(anchor.timeX, anchor.timeX);
    for (const auto rest : floats.rests) EXPECT_EQ(rest, 0);
    store.setPrecision(Precision::Double);
    expectNumbered(store, {3, 1, 0, 5, 4, 2}, {13, 10, 11, 12});
    EXPECT_FALSE(std::get<BodyStore::Columns<double>>(store.columns()).moving.anchors.kept());
    EXPECT_EQ(createdOrder(store.read<double>().moving.created, 6), (Order{3, 1, 0, 5, 4, 2}));
    EXPECT_EQ(createdOrder(store.read<double>().fixed.created, 4), (Order{3, 0, 1, 2}));
}

// ---- rows

TEST(BodyStore, PermuteTakesAllColumnsAlongAndKeepsTheOrderOfCreation) {
    BodyStore store = numberedStore();
    numberLawState(store);
    EXPECT_TRUE(store.read<double>().moving.created.isRowOrder());
    store.permute(Order{3, 1, 0, 5, 4, 2}, Order{3, 0, 1, 2});
    expectNumbered(store, {3, 1, 0, 5, 4, 2}, {13, 10, 11, 12});
    const auto bodies = store.read<double>();
    EXPECT_EQ(createdOrder(bodies.moving.created, 6), (Order{3, 1, 0, 5, 4, 2}));
    EXPECT_EQ(createdOrder(bodies.fixed.created, 4), (Order{3, 0, 1, 2}));
    const auto plain = store.advance<double>({}).plain();
    EXPECT_EQ(plain.moving.created[3], 5u);
    EXPECT_EQ(plain.fixed.created[0], 3u);
    store.append(numbered(6));
    EXPECT_EQ(store.read<double>().moving.created[6], 6u) << "the newest comes last";
}

TEST(BodyStore, PermuteRefusesAnOrderOfAnotherLength) {
    BodyStore store = numberedStore();
    EXPECT_THROW(store.permute(Order{0, 1}, Order{0, 1, 2, 3}), Error);
    EXPECT_THROW(store.permute(Order{0, 1, 2, 3, 4, 5}, Order{}), Error);
    expectNumbered(store, {0, 1, 2, 3, 4, 5}, {10, 11, 12, 13});
}

TEST(BodyStore, EraseTakesAllColumnsAlongEvenAfterPermute) {
    BodyStore store = numberedStore();
    numberLawState(store);
    store.permute(Order{3, 1, 0, 5, 4, 2}, Order{3, 0, 1, 2});
    std::map<std::uint32_t, BodyRef> moved;
    store.erase([](std::uint32_t entity) { return entity == 1 || entity == 4 || entity == 13; },
                [&](std::uint32_t entity, BodyRef to) { moved[entity] = to; });
    expectNumbered(store, {3, 0, 5, 2}, {10, 11, 12});
    EXPECT_EQ(createdOrder(store.read<double>().moving.created, 4), (Order{3, 0, 5, 2}));
    EXPECT_EQ(createdOrder(store.read<double>().fixed.created, 3), (Order{0, 1, 2}));
    // Of all that lie elsewhere now.
    EXPECT_EQ(moved.at(0), BodyRef::moving(1));
    EXPECT_EQ(moved.at(5), BodyRef::moving(2));
    EXPECT_EQ(moved.at(2), BodyRef::moving(3));
    EXPECT_EQ(moved.at(10), BodyRef::fixed(0));
    EXPECT_EQ(moved.at(12), BodyRef::fixed(2));
    EXPECT_FALSE(moved.contains(1));
    EXPECT_FALSE(moved.contains(13));
}

TEST(BodyStore, EraseRowPutsTheLastRowThereAndNoOther) {
    BodyStore store = numberedStore();
    numberLawState(store);
    std::map<std::uint32_t, BodyRef> moved;
    const auto note = [&](std::uint32_t entity, BodyRef to) { moved[entity] = to; };
    store.eraseRow(BodyRef::moving(1), note);
    expectNumbered(store, {0, 5, 2, 3, 4}, {10, 11, 12, 13});
    EXPECT_EQ(moved, (std::map<std::uint32_t, BodyRef>{{5, BodyRef::moving(1)}}));
    store.eraseRow(BodyRef::moving(4), note);
    store.eraseRow(BodyRef::fixed(0), note);
    expectNumbered(store, {0, 5, 2, 3}, {13, 11, 12});
    EXPECT_EQ(moved.size(), 2u);
    EXPECT_EQ(moved.at(13), BodyRef::fixed(0));
    EXPECT_EQ(createdOrder(store.read<double>().moving.created, 4), (Order{0, 5, 2, 3}));
    EXPECT_EQ(createdOrder(store.read<double>().fixed.created, 3), (Order{3, 1, 2}));
    store.append(numbered(6));
    EXPECT_EQ(store.read<double>().moving.created[4], 6u) << "the newest comes last";
}

TEST(BodyStore, EraseRowOfTheLastKeepsTheRowsInOrder) {
    BodyStore store = numberedStore();
    store.eraseRow(BodyRef::moving(5), [](std::uint32_t, BodyRef) { FAIL(); });
    EXPECT_TRUE(store.read<double>().moving.created.isRowOrder());
}

/// Counts what the one list of columns hands out.
template <class Set>
std::size_t columnsOf(const Set& set, std::size_t rows) {
    std::size_t count = 0;
    set.forEachColumn(
        [&](ColumnInfo info, const auto& column) {
            ++count;
            EXPECT_NE(std::string(info.name), "");
            if constexpr (requires { column.kept(); }) {
                EXPECT_EQ(column.stored().size(), column.kept() ? rows : 0);
            } else {
                EXPECT_EQ(column.size(), rows) << info.name;
            }
        },
        set);
    return count;
}

TEST(BodyStore, TheListOfColumnsNamesThemAll) {
    BodyStore store = numberedStore();
    numberLawState(store);
    const auto& [m, f] = std::get<BodyStore::Columns<double>>(store.columns());
    EXPECT_EQ(columnsOf(m, 6), 11u);
    EXPECT_EQ(columnsOf(f, 4), 7u);
    // A column that is not on the list has a place in the type and none in its sum.
    std::size_t bytes = 0;
    const auto add = [&](ColumnInfo, const auto& column) { bytes += sizeof column; };
    m.forEachColumn(add, m);
    EXPECT_EQ(bytes, sizeof m);
    bytes = 0;
    f.forEachColumn(add, f);
    EXPECT_EQ(bytes, sizeof f);
}

TEST(BodyStore, HandsOutConstValuesToReaders) {
    using View = decltype(std::declval<const BodyStore&>().read<double>());
    static_assert(std::is_same_v<decltype(View::moving.x[0]), const double&>);
    static_assert(std::is_same_v<decltype(View::moving.entity[0]), const std::uint32_t&>);
    using Editable = std::remove_cvref_t<decltype(*std::declval<BodyStore::Edit<double>&>())>;
    static_assert(std::is_same_v<decltype(Editable::moving.x[0]), double&>);
    static_assert(std::is_same_v<decltype(Editable::fixed.x[0]), const double&>);
    const BodyStore store = numberedStore();
    EXPECT_THROW(store.read<float>(), Error);
}

TEST(BodyStore, BytesCountEveryColumn) {
    BodyStore store;
    EXPECT_EQ(store.bytes(), 0u);
    store.append(numbered(0));
    const std::size_t uniform = store.bytes();
    EXPECT_EQ(uniform, 4 * sizeof(double) + sizeof(std::uint32_t));
    store.append(numbered(1));  // another size, another mass
    EXPECT_EQ(store.bytes(), 2 * (7 * sizeof(double) + sizeof(std::uint32_t)));
    store.advance<double>({.anchors = true});
    EXPECT_EQ(store.bytes(),
              2 * (7 * sizeof(double) + sizeof(std::uint32_t)) + 2 * sizeof(Anchor<double>));
}

}  // namespace
}  // namespace quadrille
