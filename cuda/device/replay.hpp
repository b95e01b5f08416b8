#pragma once

#include <cuda_runtime_api.h>

namespace quadrille::cuda {

/// Work for a stream that comes again and again with the same arguments: it is recorded once, as a
/// CUDA graph, and takes one launch from then on instead of one for each of its kernels.
class Replay {
  public:
    Replay() = default;
    ~Replay() { forget(); }
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    /// Does what `enqueue` puts into the stream, or put there when it was recorded. It must neither
    /// allocate nor wait.
    template <class Enqueue>
    void run(cudaStream_t stream, Enqueue&& enqueue) {
        if (graph_ == nullptr) {
            begin(stream);
            try {
                enqueue();
            } catch (...) {
                abandon(stream);
                throw;
            }
            end(stream);
        }
        launch(stream);
    }
    /// The arguments are others from now on.
    void forget();

  private:
    static void begin(cudaStream_t stream);
    static void abandon(cudaStream_t stream);
    void end(cudaStream_t stream);
    void launch(cudaStream_t stream);

    cudaGraphExec_t graph_ = nullptr;
};

}  // namespace quadrille::cuda
