#pragma once

/// FLANKWRIGHT_WIDE_REGISTERS before a function: its loops are compiled for registers of four and eight numbers too, and the processor
/// decides at run time. The result is the same to the bit: loops that add to many numbers keep the order of each, and products are not fused
/// (-ffp-contract=off). Left out under sanitizers, which start later than that decision.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLANKWRIGHT_WIDE_REGISTERS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FLANKWRIGHT_WIDE_REGISTERS
#endif
