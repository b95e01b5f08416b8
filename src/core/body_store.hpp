#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include <quadrille/bodies.hpp>
#include <quadrille/body_ref.hpp>
#include <quadrille/config.hpp>
#include <quadrille/error.hpp>
#include <quadrille/vec2.hpp>

#include "collision/law_bodies.hpp"
#include "core/columns.hpp"

namespace quadrille {

/// What is true of all values of a column.
struct ColumnInfo {
    const char* name;       ///< for messages
    bool positive = false;  ///< else finite is enough
};

template <class Real>
struct MovingColumns {
    PlainColumn<Real> x, y, vx, vy;
    Column<Real> halfWidth, halfHeight, mass;
    PlainColumn<std::uint32_t> entity;
    CreationColumn created;
    OptionalColumn<Anchor<Real>> anchors;
    OptionalColumn<std::uint8_t> rests;

    /// The one list of columns: calls `function(info, column...)` with the same column of each of
    /// the `sets`. Converting, compacting, permuting, saving, checking and counting all go by it.
    template <class Function, class... Sets>
    static void forEachColumn(Function&& function, Sets&&... sets) {
        function(ColumnInfo{"position"}, sets.x...);
        function(ColumnInfo{"position"}, sets.y...);
        function(ColumnInfo{"velocity"}, sets.vx...);
        function(ColumnInfo{"velocity"}, sets.vy...);
        function(ColumnInfo{"size", true}, sets.halfWidth...);
        function(ColumnInfo{"size", true}, sets.halfHeight...);
        function(ColumnInfo{"mass", true}, sets.mass...);
        function(ColumnInfo{"entity"}, sets.entity...);
        function(ColumnInfo{"creation number"}, sets.created...);
        function(ColumnInfo{"anchor"}, sets.anchors...);
        function(ColumnInfo{"rest"}, sets.rests...);
    }

    std::size_t size() const { return x.size(); }
};

template <class Real>
struct StaticColumns {
    PlainColumn<Real> x, y, halfWidth, halfHeight;
    Column<Real> mass;  ///< for when they move again
    PlainColumn<std::uint32_t> entity;
    CreationColumn created;

    /// As for moving bodies.
    template <class Function, class... Sets>
    static void forEachColumn(Function&& function, Sets&&... sets) {
        function(ColumnInfo{"position"}, sets.x...);
        function(ColumnInfo{"position"}, sets.y...);
        function(ColumnInfo{"size", true}, sets.halfWidth...);
        function(ColumnInfo{"size", true}, sets.halfHeight...);
        function(ColumnInfo{"mass", true}, sets.mass...);
        function(ColumnInfo{"entity"}, sets.entity...);
        function(ColumnInfo{"creation number"}, sets.created...);
    }

    std::size_t size() const { return x.size(); }
};

/// What, beside the bodies, decides what becomes of them.
struct Physics {
    Law law = Law::Impulse;
    Vec2 gravity{0, 0};  ///< px/s^2
    double restitution = 1;

    bool operator==(const Physics&) const = default;
};

inline Physics physicsOf(Law law, const StepSettings& step) {
    return {law, step.gravity, step.restitution};
}

class BodyStore;

/// Who holds a newer state than the store does: a device. Mirror and store know of each other, so
/// that either may end first.
class BodyMirror {
  public:
    BodyMirror() = default;
    virtual ~BodyMirror();
    BodyMirror(const BodyMirror&) = delete;
    BodyMirror& operator=(const BodyMirror&) = delete;

    /// Writes the newest state to the store. Throws DeviceError.
    virtual void fetch(BodyStore& store) = 0;

  protected:
    /// For a mirror that is about to end: has the store fetch what it alone knows.
    void bringHome();

  private:
    friend class BodyStore;
    BodyStore* newestOf_ = nullptr;  // of which this has the newest state
};

/// The bodies of a world in columns, and who has their newest state. Everybody who wants them asks
/// here: to read, to edit, or to advance them in time.
class BodyStore {
  public:
    template <class Real>
    struct Columns {
        MovingColumns<Real> moving;
        StaticColumns<Real> fixed;
    };
    using AnyColumns = std::variant<Columns<double>, Columns<float>>;

    /// A view that can be written for as long as this lives; then it counts as an edit, so that
    /// nobody can forget to say so.
    template <class Real>
    class Edit {
      public:
        explicit Edit(BodyStore& store) : store_(store), view_(store.mutableView<Real>()) {}
        ~Edit() { store_.countValueEdit(); }
        Edit(const Edit&) = delete;
        Edit& operator=(const Edit&) = delete;

        const MutableBodyView<Real>& operator*() const { return view_; }
        const MutableBodyView<Real>* operator->() const { return &view_; }

      private:
        BodyStore& store_;
        MutableBodyView<Real> view_;
    };

    BodyStore() = default;
    ~BodyStore() { newestIs(nullptr); }
    /// Brings the newest here, and leaves the other one empty. Throws as read() does.
    BodyStore(BodyStore&& other);  // NOLINT(performance-noexcept-move-constructor)
    BodyStore(const BodyStore&) = delete;
    BodyStore& operator=(const BodyStore&) = delete;

    Precision precision() const { return static_cast<Precision>(columns_.index()); }
    std::size_t movingCount() const;
    std::size_t staticCount() const;

    // ---- the state

    /// The newest values. Throws Error if the bodies have the other precision, and DeviceError if
    /// they cannot be brought here.
    template <class Real>
    BodyView<Real> read() const;

    template <class Real>
    Edit<Real> edit() {
        return Edit<Real>(*this);
    }

    /// For an engine: the bodies to be advanced, with the columns that its law keeps. A new row of
    /// such a column is unknown: an anchor of time NaN, a body that does not rest. Where the
    /// physics are others than last time, it is as if all bodies had been edited. A law that keeps
    /// anchors gets bodies that are to be placed later as they are, and has to say so again.
    template <class Real>
    LawBodies<Real> advance(KeptColumns kept, const Physics& physics = {});

    /// From here on the mirror has the newest state, until somebody asks for it; null to forget a
    /// mirror whose state is lost or not wanted.
    void newestIs(BodyMirror* mirror) { setMirror(mirror); }

    /// For an engine whose bodies lie elsewhere: as `advance`, but nothing is brought here, and
    /// from here on the mirror has the newest state.
    void advancedBy(BodyMirror& mirror, KeptColumns kept, const Physics& physics);

    /// From here on the bodies are where their anchors say that they are at time `t`, in s, under
    /// the physics of the last advance(). They are placed there when somebody wants to know.
    void placeLater(double t) { placedLater_ = t; }

    /// Another one after each edit, and never that of another store.
    std::uint64_t revision() const { return revision_; }
    /// The same, but for edits of positions and velocities of moving bodies.
    std::uint64_t layout() const { return layout_; }

    // ---- rows

    struct NewBody {
        Vec2 position, halfSize, velocity;
        double mass;
        bool isStatic;
        std::uint32_t entity;
    };
    /// Appends a row. Throws Error, and changes nothing, if a value does not fit the precision.
    BodyRef append(const NewBody& body);

    /// Takes out the rows whose entity satisfies `gone`, keeping the order of the rest; calls
    /// `moved(entity, BodyRef)` for each that stays.
    template <class Gone, class Moved>
    void erase(Gone&& gone, Moved&& moved);

    /// Takes out one row, in a time that does not depend on how many there are: the last row takes
    /// its place. Calls `moved(entity, BodyRef)` for that one. The order of creation stays.
    template <class Moved>
    void eraseRow(BodyRef body, Moved&& moved);

    /// Puts moving and static rows in another order: row i becomes what row order[i] was. Their
    /// order of creation stays.
    void permute(std::span<const std::uint32_t> moving, std::span<const std::uint32_t> fixed);

    void reserve(std::size_t moving);

    Vec2 position(BodyRef body) const;
    Vec2 halfSize(BodyRef body) const;
    Vec2 velocity(std::uint32_t row) const;
    double mass(BodyRef body) const;
    void setPosition(BodyRef body, const Vec2& position);
    void setHalfSize(BodyRef body, const Vec2& halfSize);
    void setVelocityAndMass(std::uint32_t row, const Vec2& velocity, double mass);
    /// Of a static body; a mass that none can have becomes 1.
    void setStaticMass(std::uint32_t row, double mass);

    /// Converts all columns; narrowing rounds to nearest, and columns of a law's own state are
    /// dropped. Throws Error, naming the entity, if a value does not fit; then nothing changes.
    void setPrecision(Precision precision);

    // ---- as a whole

    /// All columns, for who saves, loads or checks them; brings the newest here.
    const AnyColumns& columns() const {
        bringNewest();
        return columns_;
    }
    /// What was edited since a law advanced the bodies last.
    Edits edits() const { return edits_; }
    /// Under which a law advanced them last.
    const Physics& physics() const { return physics_; }
    void replace(AnyColumns columns, Edits edits, const Physics& physics) {
        newestIs(nullptr);
        placedLater_.reset();
        columns_ = std::move(columns);
        countEdit();
        edits_ = edits;
        physics_ = physics;
    }

    /// Allocated for columns.
    std::size_t bytes() const;

  private:
    friend class BodyMirror;
    friend class World;  // its editBodies guards an edit where this type is not known

    template <class Real>
    const Columns<Real>& of() const {
        const auto* columns = std::get_if<Columns<Real>>(&columns_);
        if (columns == nullptr) throw Error("world: its bodies have the other precision");
        return *columns;
    }
    template <class Real>
    Columns<Real>& of() {
        return const_cast<Columns<Real>&>(std::as_const(*this).template of<Real>());
    }
    template <class Real>
    MutableBodyView<Real> mutableView();

    /// Reading may have to write what the mirror knows, which changes nothing for the reader.
    void bringNewest() const {
        if (mirror_ != nullptr) {
            BodyMirror& mirror = *mirror_;
            setMirror(nullptr);
            mirror.fetch(const_cast<BodyStore&>(*this));
        }
        if (placedLater_) const_cast<BodyStore&>(*this).place(*std::exchange(placedLater_, {}));
    }
    void setMirror(BodyMirror* mirror) const {
        if (mirror_ != nullptr) mirror_->newestOf_ = nullptr;
        mirror_ = mirror;
        if (mirror_ != nullptr) mirror_->newestOf_ = const_cast<BodyStore*>(this);
    }
    void place(double t);
    void countEdit() {
        layout_ = revision_ = nextRevision();
        edits_ = Edits::Everything;
    }
    /// Positions and velocities of moving bodies, and nothing else.
    void countValueEdit() {
        revision_ = nextRevision();
        if (edits_ == Edits::None) edits_ = Edits::Values;
    }
    static std::uint64_t nextRevision();

    AnyColumns columns_;
    std::uint64_t revision_ = nextRevision();
    std::uint64_t layout_ = revision_;
    Edits edits_ = Edits::Everything;  // that no law knows
    Physics physics_;                  // that the last one knows
    mutable BodyMirror* mirror_ = nullptr;
    mutable std::optional<double> placedLater_;  // s
};

template <class Gone, class Moved>
void BodyStore::erase(Gone&& gone, Moved&& moved) {
    bringNewest();
    const auto compact = [&](auto& set, auto&& refOf) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (gone(set.entity[i])) continue;
            if (kept != i) {
                set.forEachColumn([&](ColumnInfo, auto& column) { column.move(i, kept); }, set);
                moved(set.entity[kept], refOf(static_cast<std::uint32_t>(kept)));
            }
            ++kept;
        }
        set.forEachColumn([&](ColumnInfo, auto& column) { column.shrink(kept); }, set);
    };
    std::visit(
        [&](auto& columns) {
            compact(columns.moving, &BodyRef::moving);
            compact(columns.fixed, &BodyRef::fixed);
        },
        columns_);
    countEdit();
}

template <class Moved>
void BodyStore::eraseRow(BodyRef body, Moved&& moved) {
    bringNewest();
    const auto fill = [&](auto& set) {
        const std::size_t row = body.row();
        const std::size_t last = set.size() - 1;
        if (row != last) {
            set.created.keepNumbers();
            set.forEachColumn([&](ColumnInfo, auto& column) { column.move(last, row); }, set);
            moved(set.entity[row], body);
        }
        set.forEachColumn([&](ColumnInfo, auto& column) { column.shrink(last); }, set);
    };
    std::visit([&](auto& columns) { body.isStatic() ? fill(columns.fixed) : fill(columns.moving); },
               columns_);
    countEdit();
}

}  // namespace quadrille
