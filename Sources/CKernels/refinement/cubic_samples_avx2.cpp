#include "refinement/cubic_samples.h"

#if defined(__x86_64__)
#include <immintrin.h>

// Without fused multiply-add, which rounds once where the portable code rounds twice.
#define CK_AVX2 __attribute__((target("avx2")))

namespace ck {
namespace {

/// Samples per register. Limit: 256 bits.
constexpr int kLanes = 8;
/// The samples of a template, in full registers. Limit: no grid is larger.
constexpr int kPaddedSamples = (CK_TEMPLATE_SAMPLES + kLanes - 1) / kLanes * kLanes;

struct Positions {
  alignas(32) float x[kPaddedSamples], y[kPaddedSamples];
};

/// The positions of a grid, rounded up to full registers by the last one.
CK_AVX2 Positions positions(const SampleGrid& grid) {
  Positions result;
  const double half = (grid.side - 1) / 2.0;
  double columns_x[CK_TEMPLATE_SIDE], columns_y[CK_TEMPLATE_SIDE];
  for (int i = 0; i < grid.side; ++i) {
    columns_x[i] = grid.x + (i - half) * grid.ax;
    columns_y[i] = grid.y + (i - half) * grid.ay;
  }
  int k = 0;
  for (int j = 0; j < grid.side; ++j) {
    const double row_x = (j - half) * grid.bx, row_y = (j - half) * grid.by;
    for (int i = 0; i < grid.side; ++i, ++k) {
      result.x[k] = static_cast<float>(columns_x[i] + row_x);
      result.y[k] = static_cast<float>(columns_y[i] + row_y);
    }
  }
  for (; k % kLanes; ++k) result.x[k] = result.x[k - 1], result.y[k] = result.y[k - 1];
  return result;
}

/// The weight of one of four adjacent pixels, in the order of operations of the portable code.
template <int tap>
CK_AVX2 inline __m256 weight(__m256 t) {
  const auto number = [](float value) CK_AVX2 { return _mm256_set1_ps(value); };
  if constexpr (tap == 0) {
    const __m256 a = _mm256_add_ps(_mm256_mul_ps(number(-0.5f), t), number(1));
    return _mm256_mul_ps(_mm256_sub_ps(_mm256_mul_ps(a, t), number(0.5f)), t);
  } else if constexpr (tap == 1) {
    const __m256 a = _mm256_sub_ps(_mm256_mul_ps(number(1.5f), t), number(2.5f));
    return _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(a, t), t), number(1));
  } else if constexpr (tap == 2) {
    const __m256 a = _mm256_add_ps(_mm256_mul_ps(number(-1.5f), t), number(2));
    return _mm256_mul_ps(_mm256_add_ps(_mm256_mul_ps(a, t), number(0.5f)), t);
  } else {
    const __m256 a = _mm256_sub_ps(_mm256_mul_ps(number(0.5f), t), number(0.5f));
    return _mm256_mul_ps(_mm256_mul_ps(a, t), t);
  }
}

/// One of four adjacent pixels, each a byte of its register.
template <int tap>
CK_AVX2 inline __m256 pixel(__m256i quad) {
  const __m256i byte = _mm256_and_si256(_mm256_srli_epi32(quad, 8 * tap), _mm256_set1_epi32(255));
  return _mm256_cvtepi32_ps(byte);
}

/// Four adjacent pixels at each offset. The instruction for this is not faster on all processors:
/// on an AMD EPYC, sampling with it takes a tenth longer.
CK_AVX2 inline __m256i gather(const uint8_t* pixels, const int32_t* offsets) {
  alignas(32) int32_t quads[kLanes];
  for (int i = 0; i < kLanes; ++i) __builtin_memcpy(&quads[i], pixels + offsets[i], 4);
  return _mm256_set_epi32(quads[7], quads[6], quads[5], quads[4], quads[3], quads[2], quads[1],
                          quads[0]);
}

/// A column of four rows, times the weights of the rows and its own.
template <int tap>
CK_AVX2 inline __m256 column(const __m256i* rows, const __m256* by_row, __m256 t) {
  __m256 sum = _mm256_mul_ps(pixel<tap>(rows[0]), by_row[0]);
  for (int r = 1; r < 4; ++r) {
    sum = _mm256_add_ps(sum, _mm256_mul_ps(pixel<tap>(rows[r]), by_row[r]));
  }
  return _mm256_mul_ps(sum, weight<tap>(t));
}

}  // namespace

CK_AVX2 void sample_cubic_avx2(const SampleGrid& grid, float* values) {
  const Positions at = positions(grid);
  alignas(32) float padded[kPaddedSamples];
  const int count = grid.side * grid.side;
  for (int k = 0; k < count; k += kLanes) {
    const __m256 x = _mm256_load_ps(at.x + k), y = _mm256_load_ps(at.y + k);
    const __m256i columns = _mm256_cvttps_epi32(x), lines = _mm256_cvttps_epi32(y);
    const __m256 tx = _mm256_sub_ps(x, _mm256_cvtepi32_ps(columns));
    const __m256 ty = _mm256_sub_ps(y, _mm256_cvtepi32_ps(lines));
    const __m256i one = _mm256_set1_epi32(1);
    // Offsets have 31 bits: images have fewer pixels.
    const __m256i first = _mm256_add_epi32(
        _mm256_mullo_epi32(_mm256_sub_epi32(lines, one), _mm256_set1_epi32(int(grid.stride))),
        _mm256_sub_epi32(columns, one));
    alignas(32) int32_t offsets[kLanes];
    _mm256_store_si256(reinterpret_cast<__m256i*>(offsets), first);
    __m256i rows[4];
    for (int r = 0; r < 4; ++r) {
      rows[r] = gather(grid.pixels + static_cast<size_t>(r) * grid.stride, offsets);
    }
    const __m256 by_row[4] = {weight<0>(ty), weight<1>(ty), weight<2>(ty), weight<3>(ty)};
    const __m256 left = _mm256_add_ps(column<0>(rows, by_row, tx), column<1>(rows, by_row, tx));
    const __m256 right = _mm256_add_ps(column<2>(rows, by_row, tx), column<3>(rows, by_row, tx));
    _mm256_store_ps(padded + k, _mm256_add_ps(left, right));
  }
  __builtin_memcpy(values, padded, static_cast<size_t>(count) * sizeof(float));
}

}  // namespace ck
#else
namespace ck {
void sample_cubic_avx2(const SampleGrid& grid, float* values) { sample_cubic(grid, values); }
}  // namespace ck
#endif
