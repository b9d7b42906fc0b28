#ifndef CK_RETRIEVAL_H
#define CK_RETRIEVAL_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Learns a visual vocabulary from descriptors of 128 bytes by k-means (Lloyd's algorithm).
///
/// `words` receives `word_count` descriptors. The initial words are drawn from the descriptors, of
/// which there must be at least `word_count`; the same seed gives the same words.
ck_status ck_learn_words(const uint8_t* descriptors, size_t count, size_t word_count,
                         int32_t iterations, uint64_t seed, const ck_control* control,
                         uint8_t* words);

/// Encodes an image by the residuals of its descriptors (VLAD, Jégou et al., CVPR 2010), with
/// intra-normalization: the sum at each word is scaled to unit length (Arandjelović and Zisserman,
/// CVPR 2013).
///
/// `vector` receives `word_count × 128` numbers with a total length of 1, or zeros if there are no
/// descriptors.
ck_status ck_encode_vlad(const uint8_t* descriptors, size_t count, const uint8_t* words,
                         size_t word_count, const ck_control* control, float* vector);

/// Finds the most similar other vectors for each of `count` vectors of `length` elements, by inner
/// product.
///
/// `indices` and `similarities` receive `neighbor_count` entries per vector, the most similar
/// first; ties go to the lower index. `neighbor_count` is less than `count`.
ck_status ck_most_similar(const float* vectors, size_t count, size_t length, size_t neighbor_count,
                          const ck_control* control, int32_t* indices, float* similarities);

#ifdef __cplusplus
}
#endif
#endif
