#pragma once

#if __has_include(<nvtx3/nvToolsExt.h>)
#include <nvtx3/nvToolsExt.h>
#endif

namespace quadrille::cuda {

/// Names a stretch of time for the profiler, where its headers are there.
class Range {
  public:
#if __has_include(<nvtx3/nvToolsExt.h>)
    explicit Range(const char* name) { nvtxRangePushA(name); }
    ~Range() { nvtxRangePop(); }
#else
    explicit Range(const char*) {}
    ~Range() {}
#endif
    Range(const Range&) = delete;
    Range& operator=(const Range&) = delete;
};

}  // namespace quadrille::cuda
