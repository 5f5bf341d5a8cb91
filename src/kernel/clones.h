/* PIA_CLONES before a static function (others would be seen outside the library): the compiler makes a version for processors with AVX2
 * beside the portable one, and the loader picks. The bits are the same: sums keep their lanes, and multiplications and additions are
 * never contracted. PIA_INLINE: functions that must become part of every version. PIA_WIDE: for processors with AVX-512
 * alone, which who calls them asks for by pia_has_wide. Sanitizers instrument the choice itself before they
 * are ready for it, and clang 14 cannot link it: they get one version. */
#ifndef PIA_KERNEL_CLONES_H
#define PIA_KERNEL_CLONES_H

#include <stdint.h> /* tells __GLIBC__ */

#define PIA_INLINE static inline __attribute__((always_inline))

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define PIA_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define PIA_CLONES
#endif

#if defined(__x86_64__)
#define PIA_WIDE __attribute__((target("avx512f")))
#else
#define PIA_WIDE
#endif

static inline int pia_has_wide(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f");
#else
    return 0;
#endif
}

#endif
