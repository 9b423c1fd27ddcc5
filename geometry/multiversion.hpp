// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @brief Before a function: compiled for AVX-512, AVX2 and the baseline, and chosen when the
/// program starts, so that one binary is fast on new processors and runs on old ones. Elsewhere
/// (ARM, other compilers, sanitizers, which the choice would precede) the function is compiled
/// once. All versions give the same bytes as long as the loops inside work element by element: the
/// compiler neither reorders sums nor contracts products here. GEOMAP_ONLY_TARGET names one version
/// to compile alone, so that a test can compare them all on one processor.
#if defined(GEOMAP_ONLY_TARGET)
#define GEOMAP_MULTIVERSION __attribute__((target(GEOMAP_ONLY_TARGET)))
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(GEOMAP_SINGLE_VERSION)
#define GEOMAP_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define GEOMAP_MULTIVERSION
#endif
