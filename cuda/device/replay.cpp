#include "cuda/device/replay.hpp"

#include <utility>

#include "cuda/device/check.hpp"

namespace quadrille::cuda {

void Replay::begin(cudaStream_t stream) {
    check(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal),
          "cudaStreamBeginCapture");
}

void Replay::abandon(cudaStream_t stream) {
    cudaGraph_t recorded = nullptr;
    cudaStreamEndCapture(stream, &recorded);
    if (recorded != nullptr) cudaGraphDestroy(recorded);
    cudaGetLastError();  // what failed is on its way already
}

void Replay::end(cudaStream_t stream) {
    cudaGraph_t recorded = nullptr;
    check(cudaStreamEndCapture(stream, &recorded), "cudaStreamEndCapture");
    const cudaError_t error = cudaGraphInstantiate(&graph_, recorded, 0);
    cudaGraphDestroy(recorded);
    check(error, "cudaGraphInstantiate");
}

void Replay::launch(cudaStream_t stream) {
    check(cudaGraphLaunch(graph_, stream), "cudaGraphLaunch");
}

void Replay::forget() {
    if (graph_ != nullptr) cudaGraphExecDestroy(std::exchange(graph_, nullptr));
}

}  // namespace quadrille::cuda
