// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How inner loops are compiled.
 *
 * TRIVARIATE_CLONES before a function: compiled also for wider vector units, the best one of the
 * machine chosen when the library is loaded. Only for kernels whose rounding may differ from
 * machine to machine (fused multiply-add); on one machine the numbers are always the same.
 * TRIVARIATE_INLINE before a function: made part of its callers, so of each clone.
 */
#ifndef trivariate_TargetClones_h
#define trivariate_TargetClones_h

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TRIVARIATE_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define TRIVARIATE_CLONES
#endif

#if defined(__GNUC__)
#define TRIVARIATE_INLINE inline __attribute__((always_inline))
#else
#define TRIVARIATE_INLINE inline
#endif

#endif
