// Loads and stores of vectors, included once for each instruction set: a function that returns a
// vector must be compiled for the same set as its caller.

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

}  // namespace
}  // namespace ck
