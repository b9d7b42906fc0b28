// OpenMP on one thread, for LibRaw: the program decodes photos on threads of its own.
//
// The functions that GCC calls for parallel regions and loops (libgomp's ABI). The calling thread is
// the only one of each team.
#include <stdbool.h>

int omp_get_num_threads(void) { return 1; }
int omp_get_thread_num(void) { return 0; }
int omp_get_max_threads(void) { return 1; }
void omp_set_num_threads(int count) { (void)count; }

void GOMP_parallel(void (*body)(void *), void *data, unsigned threads, unsigned flags) {
  (void)threads;
  (void)flags;
  body(data);
}

void GOMP_barrier(void) {}
void GOMP_critical_start(void) {}
void GOMP_critical_end(void) {}
void GOMP_critical_name_start(void **lock) { (void)lock; }
void GOMP_critical_name_end(void **lock) { (void)lock; }
void GOMP_loop_end(void) {}
void GOMP_loop_end_nowait(void) {}

// The first call of a loop gives the thread all iterations, the next one none.
static bool all(long start, long end, long *first, long *last) {
  *first = start;
  *last = end;
  return start != end;
}

bool GOMP_loop_nonmonotonic_dynamic_start(long start, long end, long step, long chunk, long *first,
                                          long *last) {
  (void)step;
  (void)chunk;
  return all(start, end, first, last);
}

bool GOMP_loop_nonmonotonic_guided_start(long start, long end, long step, long chunk, long *first,
                                         long *last) {
  (void)step;
  (void)chunk;
  return all(start, end, first, last);
}

bool GOMP_loop_nonmonotonic_dynamic_next(long *first, long *last) {
  (void)first;
  (void)last;
  return false;
}

bool GOMP_loop_nonmonotonic_guided_next(long *first, long *last) {
  (void)first;
  (void)last;
  return false;
}
