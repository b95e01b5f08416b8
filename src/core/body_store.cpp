#include "core/body_store.hpp"

#include <atomic>
#include <string>
#include <utility>

#include "collision/rules/paths.hpp"
#include "core/fits.hpp"

namespace quadrille {

namespace {

/// Rounds to Real.
template <class Real>
Real toReal(double value, ColumnInfo info) {
    if (!fits<Real>(value, info.positive)) {
        throw Error(std::string(info.name) + " does not fit the precision of the world");
    }
    return static_cast<Real>(value);
}

/// What a static body keeps of a mass that nobody has checked.
template <class Real>
Real keptMass(double mass) {
    return fits<Real>(mass, true) ? static_cast<Real>(mass) : Real(1);
}

/// How a column of one precision becomes one of the other.
template <class To>
struct Conversion {
    std::span<const std::uint32_t> entity;  // of the rows

    To convert(double value, ColumnInfo info, std::size_t row) const {
        if (!fits<To>(value, info.positive)) {
            throw Error("entity " + std::to_string(entity[row]) + ": " + info.name +
                        " does not fit the precision of the world");
        }
        return static_cast<To>(value);
    }
    template <class From, template <class> class AnyColumn>
    void operator()(ColumnInfo info, const AnyColumn<From>& from, AnyColumn<To>& to) const {
        to.reserve(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            to.grow();
            to.set(i, convert(static_cast<double>(from[i]), info, i));
        }
    }
    template <class Column>
    void operator()(ColumnInfo, const Column& from, Column& to) const {
        to = from;
    }
    // State of a law's own, which the law finds anew.
    template <class From>
    void operator()(ColumnInfo, const OptionalColumn<Anchor<From>>&,
                    OptionalColumn<Anchor<To>>&) const {}
    void operator()(ColumnInfo, const OptionalColumn<std::uint8_t>&,
                    OptionalColumn<std::uint8_t>&) const {}
};

template <class To, class From>
BodyStore::Columns<To> converted(const BodyStore::Columns<From>& from) {
    BodyStore::Columns<To> to;
    MovingColumns<To>::forEachColumn(Conversion<To>{from.moving.entity.view()}, from.moving,
                                     to.moving);
    StaticColumns<To>::forEachColumn(Conversion<To>{from.fixed.entity.view()}, from.fixed,
                                     to.fixed);
    return to;
}

}  // namespace

BodyMirror::~BodyMirror() {
    if (newestOf_ != nullptr) newestOf_->newestIs(nullptr);
}

void BodyMirror::bringHome() {
    if (newestOf_ != nullptr) newestOf_->bringNewest();
}

BodyStore::BodyStore(BodyStore&& other)
    : columns_((other.bringNewest(), std::exchange(other.columns_, {}))),
      revision_(other.revision_),
      layout_(other.layout_),
      edits_(other.edits_),
      physics_(other.physics_) {
    other.countEdit();
}

std::uint64_t BodyStore::nextRevision() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::size_t BodyStore::movingCount() const {
    return std::visit([](const auto& columns) { return columns.moving.size(); }, columns_);
}

std::size_t BodyStore::staticCount() const {
    return std::visit([](const auto& columns) { return columns.fixed.size(); }, columns_);
}

template <class Real>
BodyView<Real> BodyStore::read() const {
    bringNewest();
    const auto& [m, f] = of<Real>();
    return {.moving = {.x = m.x.view(),
                       .y = m.y.view(),
                       .vx = m.vx.view(),
                       .vy = m.vy.view(),
                       .halfWidth = m.halfWidth.view(),
                       .halfHeight = m.halfHeight.view(),
                       .mass = m.mass.view(),
                       .entity = m.entity.view(),
                       .created = m.created.view()},
            .fixed = {.x = f.x.view(),
                      .y = f.y.view(),
                      .halfWidth = f.halfWidth.view(),
                      .halfHeight = f.halfHeight.view(),
                      .entity = f.entity.view(),
                      .created = f.created.view()},
            .revision = revision_,
            .layout = layout_};
}

template <class Real>
MutableBodyView<Real> BodyStore::mutableView() {
    const BodyView<Real> all = read<Real>();
    auto& m = of<Real>().moving;
    return {.moving = {.x = m.x.view(),
                       .y = m.y.view(),
                       .vx = m.vx.view(),
                       .vy = m.vy.view(),
                       .halfWidth = all.moving.halfWidth,
                       .halfHeight = all.moving.halfHeight,
                       .mass = all.moving.mass,
                       .entity = all.moving.entity,
                       .created = all.moving.created},
            .fixed = all.fixed,
            .revision = revision_,
            .layout = layout_};
}

template <class Real>
LawBodies<Real> BodyStore::advance(KeptColumns kept, const Physics& physics) {
    const Edits edits = physics == physics_ ? edits_ : Edits::Everything;
    std::optional<double> later;
    if (kept.anchors && edits == Edits::None) later = std::exchange(placedLater_, {});
    bringNewest();
    auto& m = of<Real>().moving;
    m.anchors.keep(kept.anchors, m.size());
    m.rests.keep(kept.rests, m.size());
    edits_ = Edits::None;
    physics_ = physics;
    return {mutableView<Real>(), m.anchors.view(), m.rests.view(), edits, !later};
}

/// Puts the bodies where their anchors say that they are at a time.
void BodyStore::place(double t) {
    const auto placeAll = [&]<class Real, class Path>(const LawBodies<Real>& bodies, Path) {
        const ExactMotion<Real, Path> motion{.bodies = bodies.plain(),
                                             .gravityX = physics_.gravity.x(),
                                             .gravityY = physics_.gravity.y(),
                                             .restitution = physics_.restitution};
        const auto rows = static_cast<std::uint32_t>(bodies.moving.size());
        for (std::uint32_t row = 0; row < rows; ++row) motion.place(row, t);
    };
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            auto& m = columns.moving;
            const LawBodies<Real> bodies{mutableView<Real>(), m.anchors.view(), m.rests.view()};
            if (physics_.gravity == Vec2(0, 0)) {
                placeAll(bodies, StraightPath{});
            } else {
                placeAll(bodies, FallingPath{});
            }
        },
        columns_);
}

void BodyStore::advancedBy(BodyMirror& mirror, KeptColumns kept, const Physics& physics) {
    std::visit(
        [&](auto& columns) {
            auto& m = columns.moving;
            m.anchors.keep(kept.anchors, m.size());
            m.rests.keep(kept.rests, m.size());
        },
        columns_);
    edits_ = Edits::None;
    physics_ = physics;
    placedLater_.reset();
    newestIs(&mirror);
}

BodyRef BodyStore::append(const NewBody& body) {
    bringNewest();
    const auto room = [](std::size_t rows) {
        if (rows >= BodyRef::mostRows) throw Error("world: too many bodies");
        return static_cast<std::uint32_t>(rows);
    };
    const BodyRef ref = std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto x = toReal<Real>(body.position.x(), {"position"});
            const auto y = toReal<Real>(body.position.y(), {"position"});
            const auto halfWidth = toReal<Real>(body.halfSize.x(), {"size", true});
            const auto halfHeight = toReal<Real>(body.halfSize.y(), {"size", true});
            const auto grow = [](ColumnInfo, auto& column) { column.grow(); };
            const auto setCommon = [&](auto& set, std::uint32_t row) {
                set.x.set(row, x);
                set.y.set(row, y);
                set.halfWidth.set(row, halfWidth);
                set.halfHeight.set(row, halfHeight);
                set.entity.set(row, body.entity);
            };
            if (body.isStatic) {
                auto& f = columns.fixed;
                const std::uint32_t row = room(f.size());
                f.forEachColumn(grow, f);
                setCommon(f, row);
                f.mass.set(row, keptMass<Real>(body.mass));
                return BodyRef::fixed(row);
            }
            auto& m = columns.moving;
            const auto vx = toReal<Real>(body.velocity.x(), {"velocity"});
            const auto vy = toReal<Real>(body.velocity.y(), {"velocity"});
            const auto mass = toReal<Real>(body.mass, {"mass", true});
            const std::uint32_t row = room(m.size());
            m.forEachColumn(grow, m);
            setCommon(m, row);
            m.vx.set(row, vx);
            m.vy.set(row, vy);
            m.mass.set(row, mass);
            return BodyRef::moving(row);
        },
        columns_);
    countEdit();
    return ref;
}

void BodyStore::permute(std::span<const std::uint32_t> moving,
                        std::span<const std::uint32_t> fixed) {
    bringNewest();
    std::visit(
        [&](auto& columns) {
            auto& [m, f] = columns;
            if (moving.size() != m.size() || fixed.size() != f.size()) {
                throw Error("world: an order must name each row once");
            }
            m.forEachColumn([&](ColumnInfo, auto& column) { column.permute(moving); }, m);
            f.forEachColumn([&](ColumnInfo, auto& column) { column.permute(fixed); }, f);
        },
        columns_);
    // Rows have moved, but nothing has happened to the bodies.
    const Edits edits = edits_;
    countEdit();
    edits_ = edits;
}

void BodyStore::reserve(std::size_t moving) {
    std::visit(
        [&](auto& columns) {
            auto& m = columns.moving;
            const std::size_t total = m.size() + moving;
            m.forEachColumn([&](ColumnInfo, auto& column) { column.reserve(total); }, m);
        },
        columns_);
}

Vec2 BodyStore::position(BodyRef body) const {
    bringNewest();
    return std::visit(
        [&](const auto& columns) {
            const std::uint32_t row = body.row();
            return body.isStatic() ? Vec2(columns.fixed.x[row], columns.fixed.y[row])
                                   : Vec2(columns.moving.x[row], columns.moving.y[row]);
        },
        columns_);
}

Vec2 BodyStore::halfSize(BodyRef body) const {
    return std::visit(
        [&](const auto& columns) {
            const std::uint32_t row = body.row();
            const auto of = [&](const auto& set) {
                return Vec2(set.halfWidth[row], set.halfHeight[row]);
            };
            return body.isStatic() ? of(columns.fixed) : of(columns.moving);
        },
        columns_);
}

Vec2 BodyStore::velocity(std::uint32_t row) const {
    bringNewest();
    return std::visit(
        [&](const auto& columns) { return Vec2(columns.moving.vx[row], columns.moving.vy[row]); },
        columns_);
}

double BodyStore::mass(BodyRef body) const {
    return std::visit(
        [&](const auto& columns) {
            const std::uint32_t row = body.row();
            return static_cast<double>(body.isStatic() ? columns.fixed.mass[row]
                                                       : columns.moving.mass[row]);
        },
        columns_);
}

void BodyStore::setPosition(BodyRef body, const Vec2& position) {
    bringNewest();
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto x = toReal<Real>(position.x(), {"position"});
            const auto y = toReal<Real>(position.y(), {"position"});
            const auto set = [&](auto& rows) {
                rows.x.set(body.row(), x);
                rows.y.set(body.row(), y);
            };
            body.isStatic() ? set(columns.fixed) : set(columns.moving);
        },
        columns_);
    body.isStatic() ? countEdit() : countValueEdit();
}

void BodyStore::setHalfSize(BodyRef body, const Vec2& halfSize) {
    bringNewest();
    std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto halfWidth = toReal<Real>(halfSize.x(), {"size", true});
            const auto halfHeight = toReal<Real>(halfSize.y(), {"size", true});
            const auto set = [&](auto& rows) {
                rows.halfWidth.set(body.row(), halfWidth);
                rows.halfHeight.set(body.row(), halfHeight);
            };
            body.isStatic() ? set(columns.fixed) : set(columns.moving);
        },
        columns_);
    countEdit();
}

void BodyStore::setVelocityAndMass(std::uint32_t row, const Vec2& velocity, double mass) {
    bringNewest();
    const bool sameMass = std::visit(
        [&]<class Real>(Columns<Real>& columns) {
            const auto vx = toReal<Real>(velocity.x(), {"velocity"});
            const auto vy = toReal<Real>(velocity.y(), {"velocity"});
            const auto massOfBody = toReal<Real>(mass, {"mass", true});
            columns.moving.vx.set(row, vx);
            columns.moving.vy.set(row, vy);
            if (columns.moving.mass[row] == massOfBody) return true;
            columns.moving.mass.set(row, massOfBody);
            return false;
        },
        columns_);
    sameMass ? countValueEdit() : countEdit();
}

void BodyStore::setStaticMass(std::uint32_t row, double mass) {
    bringNewest();
    std::visit([&]<class Real>(
                   Columns<Real>& columns) { columns.fixed.mass.set(row, keptMass<Real>(mass)); },
               columns_);
    countEdit();
}

void BodyStore::setPrecision(Precision precision) {
    if (precision == this->precision()) return;
    bringNewest();
    if (precision == Precision::Float) {
        columns_ = converted<float>(of<double>());
    } else {
        columns_ = converted<double>(of<float>());
    }
    countEdit();
}

std::size_t BodyStore::bytes() const {
    return std::visit(
        [](const auto& columns) {
            std::size_t sum = 0;
            const auto add = [&](ColumnInfo, const auto& column) { sum += column.bytes(); };
            columns.moving.forEachColumn(add, columns.moving);
            columns.fixed.forEachColumn(add, columns.fixed);
            return sum;
        },
        columns_);
}

#define QUADRILLE_INSTANTIATE(Real)                                \
    template BodyView<Real> BodyStore::read<Real>() const;         \
    template MutableBodyView<Real> BodyStore::mutableView<Real>(); \
    template LawBodies<Real> BodyStore::advance<Real>(KeptColumns, const Physics&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille
