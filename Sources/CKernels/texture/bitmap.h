#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ck::texture {

/// A binary image with 64 texels per word. Each row ends with a spare word that stays zero, so that
/// 64 texels can be read from any position.
class Bitmap {
 public:
  static constexpr int kWord = 64;  // Limit: the bits of `uint64_t`.

  Bitmap() = default;
  Bitmap(int width, int height)
      : width_(width),
        height_(height),
        words_((width + kWord - 1) / kWord),
        bits_(static_cast<size_t>(words_ + 1) * static_cast<size_t>(height), 0) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int words() const { return words_; }

  uint64_t* row(int y) {
    return bits_.data() + static_cast<size_t>(y) * static_cast<size_t>(words_ + 1);
  }
  const uint64_t* row(int y) const {
    return bits_.data() + static_cast<size_t>(y) * static_cast<size_t>(words_ + 1);
  }

  bool get(int x, int y) const { return row(y)[x / kWord] >> (x % kWord) & 1; }
  void set(int x, int y) { row(y)[x / kWord] |= uint64_t{1} << (x % kWord); }

  /// Sets the texels from…to of a row, both included.
  void set(int from, int to, int y) {
    uint64_t* r = row(y);
    const int first = from / kWord, last = to / kWord;
    const uint64_t head = ~uint64_t{0} << (from % kWord);
    const uint64_t tail = ~uint64_t{0} >> (kWord - 1 - to % kWord);
    if (first == last) {
      r[first] |= head & tail;
      return;
    }
    r[first] |= head;
    for (int w = first + 1; w < last; ++w) r[w] = ~uint64_t{0};
    r[last] |= tail;
  }

  /// 64 texels of a row starting at `x`, which is within the row.
  uint64_t window(int x, int y) const {
    const uint64_t* r = row(y) + x / kWord;
    const int shift = x % kWord;
    return shift ? r[0] >> shift | r[1] << (kWord - shift) : r[0];
  }

  /// Sets the texels of `other` translated by x and y, which may be negative; texels outside are
  /// ignored.
  void add(const Bitmap& other, int x, int y);

  /// Dilated by a square of `reach` texels; the result is larger by `reach` on each side.
  Bitmap dilated(int reach) const;

  /// Rotated by 90° from x to y.
  Bitmap rotated() const;

  /// The length of the longest run of texels of a row that are not set.
  int longest_clear_run(int y) const;

 private:
  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<uint64_t> bits_;
};

}  // namespace ck::texture
