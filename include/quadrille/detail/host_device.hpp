#pragma once

/// Marks a function that host and device share. No rule of the physics is written twice.
#ifdef __CUDACC__
#define QUADRILLE_HD __host__ __device__
#else
#define QUADRILLE_HD
#endif

/// Instead of `inline`, where what a caller doesn't use of the result must not be worked out.
#if defined(__GNUC__) || defined(__clang__)
#define QUADRILLE_INLINE inline __attribute__((always_inline))
#else
#define QUADRILLE_INLINE inline
#endif
