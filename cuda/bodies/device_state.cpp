#include "cuda/bodies/device_state.hpp"

#include <utility>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>

#include "cuda/device/check.hpp"

namespace quadrille {

CudaDevice findCudaDevice() {
    const auto unusable = [](cudaError_t error) {
        cudaGetLastError();  // else the next launch would report it again
        return CudaDevice{.name = {}, .reason = cudaGetErrorString(error)};
    };
    int count = 0;
    if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
        return unusable(error);
    }
    if (count == 0) return {.name = {}, .reason = "no CUDA device"};
    int device = 0;
    cudaDeviceProp properties{};
    if (cudaError_t error = cudaGetDevice(&device); error != cudaSuccess) return unusable(error);
    if (cudaError_t error = cudaGetDeviceProperties(&properties, device); error != cudaSuccess) {
        return unusable(error);
    }
    if (cudaError_t error = cuda::tryKernels(); error != cudaSuccess) return unusable(error);
    return {.name = properties.name, .reason = {}};
}

namespace cuda {

Stream::Stream(const CudaOptions& options) {
    if (const CudaDevice device = findCudaDevice(); !device.usable()) {
        throw DeviceError("cuda: " + device.reason);
    }
    int device = 0;
    int multiprocessors = 0;
    check(cudaGetDevice(&device), "cudaGetDevice");
    check(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device),
          "cudaDeviceGetAttribute");
    launch_.options = options;
    launch_.multiprocessors = static_cast<unsigned>(multiprocessors);
    check(cudaStreamCreateWithFlags(&launch_.stream, cudaStreamNonBlocking), "cudaStreamCreate");
}

Stream::~Stream() { cudaStreamDestroy(launch_.stream); }

StreamTimer::~StreamTimer() {
    if (from_ != nullptr) cudaEventDestroy(from_);
    if (to_ != nullptr) cudaEventDestroy(to_);
}

void StreamTimer::start(cudaStream_t stream) {
    if (from_ == nullptr) check(cudaEventCreate(&from_), "cudaEventCreate");
    if (to_ == nullptr) check(cudaEventCreate(&to_), "cudaEventCreate");
    check(cudaEventRecord(from_, stream), "cudaEventRecord");
}

void StreamTimer::stop(cudaStream_t stream) {
    check(cudaEventRecord(to_, stream), "cudaEventRecord");
    stopped_ = true;
}

double StreamTimer::take() {
    if (!std::exchange(stopped_, false)) return 0;
    float milliseconds = 0;
    check(cudaEventElapsedTime(&milliseconds, from_, to_), "cudaEventElapsedTime");
    return double(milliseconds) / 1e3;
}

void Stream::wait() const {
    check(cudaStreamSynchronize(launch_.stream), "a kernel or copy of this step");
}

namespace {

/// A column on the device: the part that was added for it, if it has values of its own.
template <class Real>
struct ColumnPart {
    ColumnView<Real> column;
    std::size_t part = 0;

    ColumnPart(PackedUpload& upload, const ColumnView<Real>& c) : column(c) {
        if (!c.uniform()) part = upload.add(c.values);
    }
    SharedColumn<Real> on(const PackedUpload& upload) const {
        return {column.uniform() ? nullptr : upload.on<const Real>(part), column.common};
    }
};

}  // namespace

template <class Real>
DeviceState<Real>::DeviceState(const CudaOptions& options, const ThreadTeam& team)
    : stream_(options), team_(team) {
    budget_.limit = options.memoryLimit;
    counts_.reserve(1);
    clear(counts_);
    hostCounts_.reserve(1);
}

template <class Real>
void DeviceState<Real>::upload(const BodyView<Real>& view) {
    const auto& m = view.moving;
    const auto& f = view.fixed;
    PackedUpload& u = bodyUpload_;
    u.clear();
    const auto column = [&](std::span<const Real> values) { return u.add(values); };
    const std::size_t x = column(m.x), y = column(m.y), vx = column(m.vx), vy = column(m.vy);
    const ColumnPart<Real> halfWidth(u, m.halfWidth), halfHeight(u, m.halfHeight), mass(u, m.mass);
    const std::size_t entity = u.add(m.entity);
    const std::size_t fx = column(f.x), fy = column(f.y);
    const std::size_t fixedWidth = column(f.halfWidth), fixedHeight = column(f.halfHeight);
    const std::size_t fixedEntity = u.add(f.entity);
    u.flatten(team_);
    clock_->finish(Phase::Flatten);
    u.send(launch().stream);

    bodies_ = {.moving = {.x = u.on<Real>(x),
                          .y = u.on<Real>(y),
                          .vx = u.on<Real>(vx),
                          .vy = u.on<Real>(vy),
                          .halfWidth = halfWidth.on(u),
                          .halfHeight = halfHeight.on(u),
                          .mass = mass.on(u),
                          .entity = u.on<const std::uint32_t>(entity),
                          .created = {},
                          .anchors = nullptr,
                          .rests = nullptr},
               .fixed = {.x = u.on<const Real>(fx),
                         .y = u.on<const Real>(fy),
                         .halfWidth = u.on<const Real>(fixedWidth),
                         .halfHeight = u.on<const Real>(fixedHeight),
                         .entity = u.on<const std::uint32_t>(fixedEntity),
                         .created = {}}};
    movingCount_ = static_cast<std::uint32_t>(m.size());
    revision_ = view.revision;
    touchedRows_.reserve(m.size());
    hostRows_.reserve(m.size());
    hostColumns_.reserve(4 * m.size());
    // Else the host would go on with what others' phases are.
    if (clock_->enabled()) stream_.wait();
    clock_->finish(Phase::CopyToDevice);
}

template <class Real>
void DeviceState<Real>::beginStep(const BodyView<Real>& view, const StepParameters<Real>& step,
                                  PhaseClock& clock) {
    clock_ = &clock;
    const bool kept = valid_ && revision_ == view.revision && movingCount_ == view.moving.size();
    valid_ = false;  // until the step has succeeded
    if (!kept) upload(view);
    cuda::beginStep(launch(), bodies_, movingCount_, step, kept, counts_.data());
    clock_->finish(Phase::Integrate);
}

template <class Real>
bool DeviceState<Real>::updateCells(const Partition<Real>& partition, std::uint32_t movingCount) {
    if (generation_ == partition.generation) return false;
    const Cells& cells = partition.cells;
    PackedUpload& u = cellUpload_;
    u.clear();
    const std::size_t offsets = u.add(std::span<const std::uint32_t>(cells.offsets));
    const std::size_t bodies = u.add(std::span<const std::uint32_t>(cells.bodies));
    std::span<const CellCoordinates> owners;
    if (partition.complete) owners = cells.coordinates;
    const std::size_t coordinates = u.add(owners);
    u.flatten(team_);
    clock_->finish(Phase::Flatten);
    begin(Phase::CopyToDevice);
    u.send(launch().stream);
    end(Phase::CopyToDevice);
    cells_ = {.offsets = u.on<const std::uint32_t>(offsets),
              .bodies = u.on<const std::uint32_t>(bodies),
              .cells = static_cast<std::uint32_t>(cells.size()),
              .entries = static_cast<std::uint32_t>(cells.bodies.size()),
              .movingCount = movingCount};
    ownership_ = {.coordinates = u.on<const CellCoordinates>(coordinates),
                  .grid = partition.grid,
                  .margin = partition.margin};
    generation_ = partition.generation;
    return true;
}

template <class Real>
void DeviceState<Real>::zeroCounts() {
    check(cudaMemsetAsync(counts_.data(), 0, sizeof(StepCounts), launch().stream),
          "cudaMemsetAsync");
}

template <class Real>
void DeviceState<Real>::restart(const BodyView<Real>& view) {
    upload(view);
    zeroCounts();
}

template <class Real>
HostResult<Real> DeviceState<Real>::hostResult() const {
    Real* const columns = hostColumns_.data();
    return {.counts = hostCounts_.data(),
            .rows = hostRows_.data(),
            .x = columns,
            .y = columns + movingCount_,
            .vx = columns + 2 * std::size_t(movingCount_),
            .vy = columns + 3 * std::size_t(movingCount_)};
}

template <class Real>
const StepCounts& DeviceState<Real>::finish() {
    stream_.wait();
    clock_->finish(Phase::Resolve);
    for (const Phase phase : {Phase::CopyToDevice, Phase::CopyToHost}) {
        clock_->move(Phase::Resolve, phase, timerOf(phase).take());
    }
    return *hostCounts_.data();
}

template <class Real>
void DeviceState<Real>::writeBack(const BodyView<Real>& view) {
    const auto& m = view.moving;
    const HostResult<Real> result = hostResult();
    // In small worlds the other threads sleep, and waking them would take longer.
    const bool awake = m.size() >= worthwhile::streamed;
    const std::size_t least = awake ? worthwhile::scattered : m.size() + 1;
    team_.shares(result.counts->touched, least, [&](std::size_t begin, std::size_t end, unsigned) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t row = result.rows[i];
            m.x[row] = result.x[i];
            m.y[row] = result.y[i];
            m.vx[row] = result.vx[i];
            m.vy[row] = result.vy[i];
        }
    });
    valid_ = true;
    clock_->finish(Phase::CopyToHost);
}

template <class Real>
StreamTimer& DeviceState<Real>::timerOf(Phase phase) {
    return phase == Phase::CopyToDevice ? copyTimer_ : publishTimer_;
}

template <class Real>
void DeviceState<Real>::begin(Phase phase) {
    if (clock_->enabled()) timerOf(phase).start(launch().stream);
}

template <class Real>
void DeviceState<Real>::end(Phase phase) {
    if (clock_->enabled()) timerOf(phase).stop(launch().stream);
}

template <class Real>
void DeviceState<Real>::fetch(void* host, const void* device, std::size_t bytes) const {
    if (bytes == 0) return;
    check(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, launch().stream),
          "copy from the device");
    stream_.wait();
}

template <class Real>
std::size_t DeviceState<Real>::bytes() const {
    return budget_.used + bodyUpload_.hostBytes() + cellUpload_.hostBytes() + hostCounts_.bytes() +
           hostRows_.bytes() + hostColumns_.bytes();
}

template class DeviceState<double>;
template class DeviceState<float>;

}  // namespace cuda

}  // namespace quadrille
