#include "cuda/device/device_session.hpp"

#include <utility>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>

#include "cuda/device/try_kernels.hpp"

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

void Stream::wait() const {
    check(cudaStreamSynchronize(launch_.stream), "a kernel or copy of this step");
}

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

DeviceSession::DeviceSession(const CudaOptions& options, const ThreadTeam& team)
    : stream_(options), team_(team) {
    budget_.limit = options.memoryLimit;
}

void DeviceSession::fetch(void* host, const void* device, std::size_t bytes) const {
    if (bytes == 0) return;
    check(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, launch().stream),
          "copy from the device");
    wait();
}

void DeviceSession::begin(Phase phase, const PhaseClock& clock) {
    if (clock.enabled()) timerOf(phase).start(launch().stream);
}

void DeviceSession::end(Phase phase, const PhaseClock& clock) {
    if (clock.enabled()) timerOf(phase).stop(launch().stream);
}

void DeviceSession::finish(PhaseClock& clock) {
    wait();
    clock.finish(Phase::Resolve);
    if (!clock.enabled()) return;
    for (std::size_t i = 0; i < phaseCount; ++i) {
        clock.move(Phase::Resolve, static_cast<Phase>(i), timers_[i].take());
    }
}

}  // namespace cuda

}  // namespace quadrille
