#include "texture/bitmap.h"

#include <algorithm>

namespace ck::texture {
namespace {

/// `to |= from << shift` over rows of words; bits shifted out at the end are lost.
void or_up(uint64_t* to, const uint64_t* from, int words, int shift) {
  const int skip = shift / Bitmap::kWord, bits = shift % Bitmap::kWord;
  for (int w = words - 1; w >= skip; --w) {
    uint64_t value = from[w - skip] << bits;
    if (bits && w > skip) value |= from[w - skip - 1] >> (Bitmap::kWord - bits);
    to[w] |= value;
  }
}

/// Sets all texels up to `reach` to the right of a texel that is set.
void spread(uint64_t* row, int words, int reach) {
  // The distance doubles each time; processed from the end in place, so each word still reads the
  // old values.
  for (int done = 0; done < reach;) {
    const int shift = std::min(done + 1, reach - done);
    or_up(row, row, words, shift);
    done += shift;
  }
}

}  // namespace

void Bitmap::add(const Bitmap& other, int x, int y) {
  for (int r = std::max(0, -y); r < std::min(other.height_, height_ - y); ++r) {
    uint64_t* to = row(y + r);
    const uint64_t* from = other.row(r);
    for (int w = 0; w < other.words_; ++w) {
      if (!from[w]) continue;
      const int start = x + w * kWord;
      // Floor division, also for negative positions.
      const int word = start >= 0 ? start / kWord : -((kWord - 1 - start) / kWord);
      const int shift = start - word * kWord;
      if (word >= 0 && word < words_) to[word] |= from[w] << shift;
      if (shift && word + 1 >= 0 && word + 1 < words_) {
        to[word + 1] |= from[w] >> (kWord - shift);
      }
    }
    if (width_ % kWord) to[words_ - 1] &= ~uint64_t{0} >> (kWord - width_ % kWord);
  }
}

Bitmap Bitmap::dilated(int reach) const {
  Bitmap wide(width_ + 2 * reach, height_);
  for (int y = 0; y < height_; ++y) {
    std::copy(row(y), row(y) + words_, wide.row(y));
    spread(wide.row(y), wide.words_, 2 * reach);
  }
  Bitmap result(wide.width_, height_ + 2 * reach);
  for (int y = 0; y < result.height_; ++y) {
    uint64_t* to = result.row(y);
    for (int r = std::max(0, y - 2 * reach); r <= std::min(height_ - 1, y); ++r) {
      const uint64_t* from = wide.row(r);
      for (int w = 0; w < wide.words_; ++w) to[w] |= from[w];
    }
  }
  return result;
}

Bitmap Bitmap::rotated() const {
  Bitmap result(height_, width_);
  for (int y = 0; y < height_; ++y) {
    const uint64_t* from = row(y);
    const int word = (height_ - 1 - y) / kWord;
    const uint64_t bit = uint64_t{1} << ((height_ - 1 - y) % kWord);
    for (int w = 0; w < words_; ++w) {
      for (uint64_t bits = from[w]; bits; bits &= bits - 1) {
        result.row(w * kWord + __builtin_ctzll(bits))[word] |= bit;
      }
    }
  }
  return result;
}

int Bitmap::longest_clear_run(int y) const {
  const uint64_t* r = row(y);
  int longest = 0, start = 0;
  for (int w = 0; w < words_; ++w) {
    const int base = w * kWord;
    for (uint64_t bits = r[w]; bits;) {
      const int first = __builtin_ctzll(bits);
      longest = std::max(longest, base + first - start);
      const uint64_t after = ~bits & (~uint64_t{0} << first);
      const int end = after ? __builtin_ctzll(after) : kWord;
      start = base + end;
      bits = end < kWord ? bits & (~uint64_t{0} << end) : 0;
    }
  }
  return std::max(longest, width_ - start);
}

}  // namespace ck::texture
