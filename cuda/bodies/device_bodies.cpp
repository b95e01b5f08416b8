#include "cuda/bodies/device_bodies.hpp"

#include <algorithm>
#include <span>

namespace quadrille::cuda {

template <class Real>
DeviceBodies<Real>::DeviceBodies(DeviceSession& device) : device_(device) {
    device_.reserveZeroed(counts_, 1);
    hostCounts_.reserve(1);
}

template <class Real>
void DeviceBodies<Real>::load(const BodyView<Real>& view, PhaseClock& clock,
                              std::span<const Anchor<Real>> anchors) {
    const auto& m = view.moving;
    const auto& f = view.fixed;
    PackedUpload& u = upload_;
    u.clear();
    const std::size_t x = u.add(m.x), y = u.add(m.y), vx = u.add(m.vx), vy = u.add(m.vy);
    // Sizes and masses that all bodies share have no values, nor do numbers that are the rows.
    const std::size_t halfWidth = u.add(m.halfWidth.values);
    const std::size_t halfHeight = u.add(m.halfHeight.values);
    const std::size_t mass = u.add(m.mass.values);
    entity_ = u.add(m.entity);
    created_ = u.add(m.created.numbers);
    const std::size_t anchor = u.add(anchors);
    const std::size_t fixedX = u.add(f.x), fixedY = u.add(f.y);
    const std::size_t fixedWidth = u.add(f.halfWidth), fixedHeight = u.add(f.halfHeight);
    fixedEntity_ = u.add(f.entity);
    fixedCreated_ = u.add(f.created.numbers);
    u.flatten(device_.team());
    clock.finish(Phase::Flatten);
    u.send(device_.launch().stream);

    const auto shared = [&](std::size_t part, const ColumnView<Real>& column) {
        return SharedColumn<Real>{u.on<const Real>(part), column.common};
    };
    const auto numbers = [&](std::size_t part) {
        return CreationNumbers{u.on<const std::uint32_t>(part)};
    };
    bodies_ = {.moving = {.x = u.on<Real>(x),
                          .y = u.on<Real>(y),
                          .vx = u.on<Real>(vx),
                          .vy = u.on<Real>(vy),
                          .halfWidth = shared(halfWidth, m.halfWidth),
                          .halfHeight = shared(halfHeight, m.halfHeight),
                          .mass = shared(mass, m.mass),
                          .entity = u.on<const std::uint32_t>(entity_),
                          .created = numbers(created_),
                          .anchors = u.on<Anchor<Real>>(anchor),
                          .rests = nullptr},
               .fixed = {.x = u.on<const Real>(fixedX),
                         .y = u.on<const Real>(fixedY),
                         .halfWidth = u.on<const Real>(fixedWidth),
                         .halfHeight = u.on<const Real>(fixedHeight),
                         .entity = u.on<const std::uint32_t>(fixedEntity_),
                         .created = numbers(fixedCreated_)}};
    movingCount_ = static_cast<std::uint32_t>(m.size());
    fixedCount_ = static_cast<std::uint32_t>(f.size());
    revision_ = view.revision;
    touchedRows_.reserve(m.size());
    hostRows_.reserve(m.size());
    hostColumns_.reserve(4 * m.size());
    // Else the host would go on with what others' phases are.
    if (clock.enabled()) device_.wait();
    clock.finish(Phase::CopyToDevice);
}

template <class Real>
void DeviceBodies<Real>::moveOn(const StepParameters<Real>& step) {
    launchBeginStep(device_.launch(), bodies_, movingCount_, step, counts_.data());
}

template <class Real>
void DeviceBodies<Real>::fetch(const MutableBodyView<Real>& bodies) const {
    const auto& from = bodies_.moving;
    const auto& to = bodies.moving;
    const std::size_t rows = movingCount_;
    const Real* const here[] = {from.x, from.y, from.vx, from.vy};
    Real* const there[] = {to.x.data(), to.y.data(), to.vx.data(), to.vy.data()};
    for (std::size_t i = 0; i < 4 && rows > 0; ++i) {
        check(cudaMemcpyAsync(hostColumns_.data() + i * rows, here[i], rows * sizeof(Real),
                              cudaMemcpyDeviceToHost, device_.launch().stream),
              "copy from the device");
    }
    device_.wait();
    device_.team().shares(rows, &Thresholds::copied, [&](std::size_t b, std::size_t e, unsigned) {
        for (std::size_t i = 0; i < 4; ++i) {
            std::copy_n(hostColumns_.data() + i * rows + b, e - b, there[i] + b);
        }
    });
}

template <class Real>
void DeviceBodies<Real>::beginStep(const LawBodies<Real>& bodies, Step<Real>& step) {
    const bool kept = valid_ && bodies.edits == Edits::None && revision_ == bodies.revision &&
                      movingCount_ == bodies.moving.size();
    valid_ = false;  // until the step has succeeded
    movingCount_ = 0;
    if (bodies.moving.size() == 0) return;
    if (!kept) load(bodies.read(), step.clock);
    movingCount_ = static_cast<std::uint32_t>(bodies.moving.size());
    moveOn(step.parameters);
}

template <class Real>
void DeviceBodies<Real>::zeroCounts() {
    device_.fill(counts_, 0);
}

template <class Real>
void DeviceBodies<Real>::restart(const LawBodies<Real>& bodies, PhaseClock& clock) {
    load(bodies.read(), clock);
    zeroCounts();
}

template <class Real>
HostResult<Real> DeviceBodies<Real>::hostResult() const {
    Real* const columns = hostColumns_.data();
    return {.counts = hostCounts_.data(),
            .rows = hostRows_.data(),
            .x = columns,
            .y = columns + movingCount_,
            .vx = columns + 2 * std::size_t(movingCount_),
            .vy = columns + 3 * std::size_t(movingCount_)};
}

template <class Real>
const StepCounts& DeviceBodies<Real>::finish(PhaseClock& clock) {
    device_.finish(clock);
    return *hostCounts_.data();
}

template <class Real>
void DeviceBodies<Real>::writeBack(const LawBodies<Real>& bodies, PhaseClock& clock) {
    const auto& m = bodies.moving;
    const HostResult<Real> result = hostResult();
    // In small worlds the other threads sleep, and waking them would take longer.
    const ThreadTeam& team = device_.team();
    const bool awake = m.size() >= team.thresholds().streamed;
    const std::size_t least = awake ? team.thresholds().scattered : m.size() + 1;
    team.shares(result.counts->touched, least, [&](std::size_t begin, std::size_t end, unsigned) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t row = result.rows[i];
            m.x[row] = result.x[i];
            m.y[row] = result.y[i];
            m.vx[row] = result.vx[i];
            m.vy[row] = result.vy[i];
        }
    });
    valid_ = true;
    clock.finish(Phase::CopyToHost);
}

template <class Real>
CanonicalOrder DeviceBodies<Real>::hostOrder() const {
    return {{upload_.onHost<std::uint32_t>(created_)},
            {upload_.onHost<std::uint32_t>(fixedCreated_)}};
}

template <class Real>
EventOrder DeviceBodies<Real>::hostEventOrder() const {
    const CanonicalOrder order = hostOrder();
    return {.moving = upload_.onHost<std::uint32_t>(entity_),
            .fixed = upload_.onHost<std::uint32_t>(fixedEntity_),
            .movingCreated = order.moving,
            .fixedCreated = order.fixed};
}

template <class Real>
std::size_t DeviceBodies<Real>::hostBytes() const {
    return upload_.hostBytes() + hostCounts_.bytes() + hostRows_.bytes() + hostColumns_.bytes();
}

template class DeviceBodies<double>;
template class DeviceBodies<float>;

}  // namespace quadrille::cuda
