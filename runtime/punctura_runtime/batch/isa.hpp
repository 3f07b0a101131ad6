// The instruction sets: for each, a vector of doubles and its operations. A file sees those that its options allow.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace punctura::batch {

/// One double without special instructions, for other processors and to compare with.
struct Portable {
  static constexpr const char* name = "portable";
  static constexpr std::size_t lanes = 1;
  using Vector = double;
  using Mask = bool;

  static Vector all(double x) noexcept { return x; }
  static Vector load(const double* from) noexcept { return *from; }
  static void store(double* to, Vector v) noexcept { *to = v; }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector negate(Vector a) noexcept { return -a; }
  static Vector root(Vector a) noexcept { return std::sqrt(a); }
  static Vector round_down(Vector a) noexcept { return std::floor(a); }
  static Vector smaller(Vector a, Vector b) noexcept { return b < a ? b : a; }
  static Vector larger(Vector a, Vector b) noexcept { return a < b ? b : a; }
  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask equal(Vector a, Vector b) noexcept { return a == b; }
  static Mask truth(bool b) noexcept { return b; }
  static Mask both(Mask a, Mask b) noexcept { return a && b; }
  static Mask either(Mask a, Mask b) noexcept { return a || b; }
  static Mask invert(Mask a) noexcept { return !a; }
  static Vector select(Mask m, Vector a, Vector b) noexcept { return m ? a : b; }
  static unsigned bits(Mask m) noexcept { return m; }
};

// _mm_min_pd(x, y) is x < y ? x : y. std::min(a, b) is b < a ? b : a, so the operands change places.
#if defined(__SSE2__) || defined(_M_X64)
/// Two doubles: every processor with 64-bit x86.
struct Sse2 {
  static constexpr const char* name = "sse2";
  static constexpr std::size_t lanes = 2;
  using Vector = __m128d;
  using Mask = __m128d;

  static Vector all(double x) noexcept { return _mm_set1_pd(x); }
  static Vector load(const double* from) noexcept { return _mm_loadu_pd(from); }
  static void store(double* to, Vector v) noexcept { _mm_storeu_pd(to, v); }
  static Vector add(Vector a, Vector b) noexcept { return _mm_add_pd(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm_sub_pd(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm_mul_pd(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return _mm_div_pd(a, b); }
  static Vector negate(Vector a) noexcept { return _mm_xor_pd(a, _mm_set1_pd(-0.0)); }
  static Vector root(Vector a) noexcept { return _mm_sqrt_pd(a); }
  /// SSE2 has no floor. Beyond 2^52 each double is a whole number; 2^52 pushes the digits behind the point out.
  static Vector round_down(Vector a) noexcept {
    const Vector sign = _mm_and_pd(a, _mm_set1_pd(-0.0)), size = _mm_xor_pd(a, sign), big = _mm_set1_pd(0x1p52);
    const Vector nearest = _mm_or_pd(_mm_sub_pd(_mm_add_pd(size, big), big), sign);
    const Vector down = _mm_sub_pd(nearest, _mm_and_pd(_mm_cmpgt_pd(nearest, a), _mm_set1_pd(1)));
    return select(_mm_cmplt_pd(size, big), down, a);
  }
  static Vector smaller(Vector a, Vector b) noexcept { return _mm_min_pd(b, a); }
  static Vector larger(Vector a, Vector b) noexcept { return _mm_max_pd(b, a); }
  static Mask less(Vector a, Vector b) noexcept { return _mm_cmplt_pd(a, b); }
  static Mask less_equal(Vector a, Vector b) noexcept { return _mm_cmple_pd(a, b); }
  static Mask equal(Vector a, Vector b) noexcept { return _mm_cmpeq_pd(a, b); }
  static Mask truth(bool b) noexcept { return _mm_castsi128_pd(_mm_set1_epi64x(b ? -1 : 0)); }
  static Mask both(Mask a, Mask b) noexcept { return _mm_and_pd(a, b); }
  static Mask either(Mask a, Mask b) noexcept { return _mm_or_pd(a, b); }
  static Mask invert(Mask a) noexcept { return _mm_xor_pd(a, truth(true)); }
  static Vector select(Mask m, Vector a, Vector b) noexcept { return _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b)); }
  static unsigned bits(Mask m) noexcept { return static_cast<unsigned>(_mm_movemask_pd(m)); }
};
#endif

#if defined(__AVX2__)
/// Four doubles.
struct Avx2 {
  static constexpr const char* name = "avx2";
  static constexpr std::size_t lanes = 4;
  using Vector = __m256d;
  using Mask = __m256d;

  static Vector all(double x) noexcept { return _mm256_set1_pd(x); }
  static Vector load(const double* from) noexcept { return _mm256_loadu_pd(from); }
  static void store(double* to, Vector v) noexcept { _mm256_storeu_pd(to, v); }
  static Vector add(Vector a, Vector b) noexcept { return _mm256_add_pd(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_pd(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mul_pd(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return _mm256_div_pd(a, b); }
  static Vector negate(Vector a) noexcept { return _mm256_xor_pd(a, _mm256_set1_pd(-0.0)); }
  static Vector root(Vector a) noexcept { return _mm256_sqrt_pd(a); }
  static Vector round_down(Vector a) noexcept { return _mm256_floor_pd(a); }
  static Vector smaller(Vector a, Vector b) noexcept { return _mm256_min_pd(b, a); }
  static Vector larger(Vector a, Vector b) noexcept { return _mm256_max_pd(b, a); }
  static Mask less(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
  static Mask equal(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
  static Mask truth(bool b) noexcept { return _mm256_castsi256_pd(_mm256_set1_epi64x(b ? -1 : 0)); }
  static Mask both(Mask a, Mask b) noexcept { return _mm256_and_pd(a, b); }
  static Mask either(Mask a, Mask b) noexcept { return _mm256_or_pd(a, b); }
  static Mask invert(Mask a) noexcept { return _mm256_xor_pd(a, truth(true)); }
  static Vector select(Mask m, Vector a, Vector b) noexcept { return _mm256_blendv_pd(b, a, m); }
  static unsigned bits(Mask m) noexcept { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
};
#endif

#if defined(__AVX512F__)
/// Eight doubles. maskz_ with all lanes: GCC 12 warns of an undefined value in its own functions without a mask.
struct Avx512 {
  static constexpr const char* name = "avx512";
  static constexpr std::size_t lanes = 8;
  using Vector = __m512d;
  using Mask = __mmask8;

  static Vector all(double x) noexcept { return _mm512_set1_pd(x); }
  static Vector load(const double* from) noexcept { return _mm512_loadu_pd(from); }
  static void store(double* to, Vector v) noexcept { _mm512_storeu_pd(to, v); }
  static Vector add(Vector a, Vector b) noexcept { return _mm512_add_pd(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm512_sub_pd(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm512_mul_pd(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return _mm512_div_pd(a, b); }
  static Vector negate(Vector a) noexcept {
    const __m512i sign = _mm512_set1_epi64(std::bit_cast<std::int64_t>(-0.0));
    return _mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(a), sign));
  }
  static Vector root(Vector a) noexcept { return _mm512_maskz_sqrt_pd(0xff, a); }
  static Vector round_down(Vector a) noexcept {
    return _mm512_maskz_roundscale_pd(0xff, a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  }
  static Vector smaller(Vector a, Vector b) noexcept { return _mm512_maskz_min_pd(0xff, b, a); }
  static Vector larger(Vector a, Vector b) noexcept { return _mm512_maskz_max_pd(0xff, b, a); }
  static Mask less(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static Mask equal(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static Mask truth(bool b) noexcept { return static_cast<Mask>(b ? 0xff : 0); }
  static Mask both(Mask a, Mask b) noexcept { return static_cast<Mask>(a & b); }
  static Mask either(Mask a, Mask b) noexcept { return static_cast<Mask>(a | b); }
  static Mask invert(Mask a) noexcept { return static_cast<Mask>(~a); }
  static Vector select(Mask m, Vector a, Vector b) noexcept { return _mm512_mask_blend_pd(m, b, a); }
  static unsigned bits(Mask m) noexcept { return m; }
};
#endif

#if defined(__aarch64__)
/// Two doubles: every 64-bit ARM processor.
struct Neon {
  static constexpr const char* name = "neon";
  static constexpr std::size_t lanes = 2;
  using Vector = float64x2_t;
  using Mask = uint64x2_t;

  static Vector all(double x) noexcept { return vdupq_n_f64(x); }
  static Vector load(const double* from) noexcept { return vld1q_f64(from); }
  static void store(double* to, Vector v) noexcept { vst1q_f64(to, v); }
  static Vector add(Vector a, Vector b) noexcept { return vaddq_f64(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return vsubq_f64(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return vmulq_f64(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return vdivq_f64(a, b); }
  static Vector negate(Vector a) noexcept { return vnegq_f64(a); }
  static Vector root(Vector a) noexcept { return vsqrtq_f64(a); }
  static Vector round_down(Vector a) noexcept { return vrndmq_f64(a); }
  // vminq_f64 treats -0 as smaller than 0, std::min does not.
  static Vector smaller(Vector a, Vector b) noexcept { return vbslq_f64(vcltq_f64(b, a), b, a); }
  static Vector larger(Vector a, Vector b) noexcept { return vbslq_f64(vcltq_f64(a, b), b, a); }
  static Mask less(Vector a, Vector b) noexcept { return vcltq_f64(a, b); }
  static Mask less_equal(Vector a, Vector b) noexcept { return vcleq_f64(a, b); }
  static Mask equal(Vector a, Vector b) noexcept { return vceqq_f64(a, b); }
  static Mask truth(bool b) noexcept { return vdupq_n_u64(b ? ~std::uint64_t{0} : 0); }
  static Mask both(Mask a, Mask b) noexcept { return vandq_u64(a, b); }
  static Mask either(Mask a, Mask b) noexcept { return vorrq_u64(a, b); }
  static Mask invert(Mask a) noexcept { return veorq_u64(a, truth(true)); }
  static Vector select(Mask m, Vector a, Vector b) noexcept { return vbslq_f64(m, a, b); }
  static unsigned bits(Mask m) noexcept {
    return static_cast<unsigned>((vgetq_lane_u64(m, 0) & 1) | (vgetq_lane_u64(m, 1) & 2));
  }
};
#endif

}  // namespace punctura::batch
