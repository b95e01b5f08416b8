#pragma once

/// Marks a function that host and device share. No rule of the physics is written twice.
#ifdef __CUDACC__
#define QUADRILLE_HD __host__ __device__
#else
#define QUADRILLE_HD
#endif
