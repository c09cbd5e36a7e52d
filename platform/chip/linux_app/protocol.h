#pragma once

#include <csignal>
#include <cstdint>

/// What an application's process and the platform say to each other: the shim asks, over a socket
/// of whole messages, and continues when it is answered. Both are of one build.
namespace linux_app {

/// What the application's process finds open. Behind what applications open themselves.
constexpr int socket_descriptor = 198;
constexpr int memory_descriptor = 199;  ///< the DDR, from its first byte on
/// How many descriptors the host must allow it, those of the shim included.
constexpr unsigned fewest_descriptors = 256;
/// The environment variable that names the folder with /dev and /sys as the application sees them.
constexpr const char* folder_variable = "MARKERVP_LINUX";

/// Sent to an application that takes too long: it tells where it is, as of any signal that ends it.
constexpr int out_of_time = SIGXCPU;

constexpr unsigned most_uio = 32;
constexpr std::uint64_t forever = ~std::uint64_t{0};
constexpr std::uint64_t no_address = ~std::uint64_t{0};

/// A device file.
enum class Device : std::uint32_t { memory, uio, buffer };

enum class What : std::uint32_t {
  hello,      ///< first of all; `a`, `b`: first byte of the DDR and one past its last
  open,       ///< device `a`, its number `b`; `a`: its address, `b`: its bytes; EIO: of a uio
              ///< without interrupt, whose file is there all the same
  map,        ///< memory at `a`, `b` bytes, `c`: MapFlags: the application sees it from now on
  read,       ///< `size` bytes at `a`; `a`: what was there
  write,      ///< `size` bytes at `a`: `b`
  interrupt,  ///< sleeps, if `c`, until uio `a` has counted another number of interrupts than `b`
  control,    ///< uio `a`: unmasks its interrupt (`b` is 1) or masks it (0)
  sleep,      ///< for `a` ns
  wait,       ///< until the time `a`, or any uio has interrupts: their sum is not `b`
  clock,      ///< the time
  store,      ///< buffer `a`: the text "sync_for_cpu 1"
  missing,    ///< a device file that does not exist was opened: the text names it
  refused,    ///< an error that tells too little: the text says what was wrong
  place,      ///< answers Reply::Kind::where: the text is where the application is
  failure,    ///< the run cannot continue: the text says why, then a line that says where
  died,       ///< of signal `a` at address `b`; the text as of a failure, without why: empty line.
              ///< Not answered
};

enum MapFlags : std::uint64_t {
  o_sync = 1,     ///< the file was opened so
  of_buffer = 2,  ///< of a u-dma-buf, whose sync_mode decides
};

struct Request {
  What what;
  std::uint32_t size;
  std::int64_t process;  ///< that asks: the one that was started, or a copy by fork()
  std::uint64_t a, b, c;
};

/// Longest text behind a request, with its zero.
constexpr unsigned longest_text = 4096;

struct Reply {
  enum class Kind : std::uint32_t {
    done,   ///< of the request
    where,  ///< the platform wants to know first where the application is
  };
  Kind kind;
  std::int32_t error;  ///< errno; 0: none
  std::uint64_t a, b;
  std::uint64_t now_ns;                ///< simulated time, of sleep, wait and clock
  std::uint32_t interrupts[most_uio];  ///< counted by each uio
};

}  // namespace linux_app
