// Loads, stores and sums of vectors, included once for each instruction set: a function that
// returns a vector must be compiled for the same set as its caller.

namespace ck {
namespace {

/// Loads the 16 numbers from `p` on.
CK_INLINE F16 load(const float* p) {
  F16 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

/// Loads the 8 numbers from `p` on.
CK_INLINE F8 load8(const float* p) {
  F8 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

/// Writes the lanes from `p` on.
template <typename Vector, typename T>
CK_INLINE void store(T* p, const Vector& v) {
  __builtin_memcpy(p, &v, sizeof v);
}

/// Adds the four quarters of a vector.
CK_INLINE F4 quarter_sums(const F16& v) {
  const F8 half = v.lo + v.hi;
  return half.lo + half.hi;
}

/// Adds the lanes of a vector, in an order that is the same for every instruction set.
CK_INLINE float sum(const F4& v) { return (v.x + v.z) + (v.y + v.w); }
CK_INLINE float sum(const F16& v) { return sum(quarter_sums(v)); }

}  // namespace
}  // namespace ck
