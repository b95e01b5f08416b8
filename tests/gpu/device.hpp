#pragma once

#include <gtest/gtest.h>

#include <quadrille/device.hpp>

/// Ends the test where no device can run it.
#define QUADRILLE_NEEDS_DEVICE()                                                            \
    if (const quadrille::CudaDevice device = quadrille::findCudaDevice(); !device.usable()) \
    GTEST_SKIP() << device.reason
