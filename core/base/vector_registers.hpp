#pragma once

/// FLANKWRIGHT_WIDE_REGISTERS before a function compiles its loops for registers of four and eight numbers too. The program takes those that the
/// processor has. The result is the same to the bit: no sum changes its order, and products are not fused (-ffp-contract=off). The macro is empty
/// under sanitizers, which start later than that choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLANKWRIGHT_WIDE_REGISTERS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FLANKWRIGHT_WIDE_REGISTERS
#endif
