// To be preloaded into another program: its calendar leaps ten years forwards and back at each look.
// The clock that only measures durations (CLOCK_MONOTONIC) never leaps.
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

namespace {

constexpr long kLeap = 10L * 365 * 86400;  // [s]

long FindSeconds(timespec& now) {
  static std::atomic<unsigned> count{0};
  ::syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  return now.tv_sec + (count++ % 2 == 0 ? kLeap : -kLeap);
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (clock != CLOCK_REALTIME) return static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  now->tv_sec = FindSeconds(*now);
  return 0;
}

time_t time(time_t* at) noexcept {
  timespec now;
  const time_t seconds = FindSeconds(now);
  if (at) *at = seconds;
  return seconds;
}

int gettimeofday(timeval* at, void*) noexcept {
  timespec now;
  at->tv_sec = FindSeconds(now);
  at->tv_usec = now.tv_nsec / 1000;
  return 0;
}

}  // extern "C"
