// HD marks a function that runs on both machines: the CPU and a CUDA GPU.
#pragma once

#ifdef __CUDACC__
#define HD __host__ __device__
#else
#define HD
#endif
