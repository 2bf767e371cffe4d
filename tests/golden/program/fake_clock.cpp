// Preloaded: the wall clock, which jumps ten years on and back at every second call of time().
#include <time.h>
#include <unistd.h>

extern "C" time_t time(time_t* out) {
  static unsigned calls;
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const time_t jumped = now.tv_sec + (calls % 3 == 1 ? 315360000 : calls % 3 == 2 ? -315360000 : 0);
  if (calls++ == 1) (void)!write(2, "the clock jumped\n", 17);
  if (out != nullptr) *out = jumped;
  return jumped;
}
