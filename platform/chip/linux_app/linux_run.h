#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <chip/linux_app/application.h>
#include <chip/linux_app/linux_devices.h>
#include <chip/system/zynq.h>
#include <chip/watch/software_watch.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <hal/hal.h>
#include <ps/cpu/program.h>

namespace platform {

/// A run of an unmodified Linux application: the PS program is the little of a Linux kernel that
/// the application needs, written with the HAL, and the application asks it over a socket.
///
/// The two go in lock step: the application runs natively, which takes no simulated time, until it
/// accesses a register, calls the kernel or asks for the time; it rests while that is done.
/// So a run is the same run every time. One in a process at a time.
class LinuxRun {
 public:
  /// Throws vp::InputError for a file that cannot be run so.
  explicit LinuxRun(const LinuxOptions& options);
  ~LinuxRun();
  LinuxRun(const LinuxRun&) = delete;
  LinuxRun& operator=(const LinuxRun&) = delete;

  /// The kernel. Its name is the application's.
  std::unique_ptr<ps::Program> program() const { return ps::Program::linked(description_); }
  /// `costs` with what the kernel's work takes.
  ps::CostTable costs(const ps::CostTable& costs) const;

  /// What is around it, before the simulation.
  void connect(Zynq& zynq, CacheContract& caches);

 private:
  struct Uio {
    std::uint32_t interrupt = 0;  ///< 0: it has none
    bool enabled = false;
    std::uint32_t count = 0;
    bool touched = true;  ///< the application accessed the device since the last one
  };
  /// A u-dma-buf: its attributes are those of the driver.
  struct Buffer {
    std::uint64_t base = 0, size = 0;
    std::uint64_t sync_mode = 1, sync_offset = 0, sync_size = 0, sync_direction = 0;
  };
  using Asked = LinuxApplication::Asked;
  using Request = linux_app::Request;
  using Reply = linux_app::Reply;

  int serve_to_end();
  void boot();
  void make_uios();
  void make_buffers();
  int end();
  void serve(const Asked& asked);
  void obey(const Asked& asked, Reply& reply);
  void open(const Request& request, Reply& reply);
  std::uint32_t read(std::uint32_t address, std::uint32_t size);
  void write(std::uint32_t address, std::uint32_t value, std::uint32_t size);
  void map(const Request& request);
  std::string owner_problem(std::uint64_t address, std::uint64_t bytes) const;
  void note_access(std::uint32_t address);
  bool has_interrupt(std::size_t number, Reply& reply);
  void control(Uio& uio, bool enable);
  std::uint32_t await_interrupt(std::size_t number, std::uint32_t seen, bool waits);
  void warn_of_masked(std::size_t number) const;
  void warn_of_uncleared(std::size_t number);
  int store(Buffer& buffer, std::size_t number, const std::string& text);
  void show(const Buffer& buffer, std::size_t number) const;
  void show(std::size_t number, const std::string& attribute, const std::string& value) const;
  int synchronise(const Buffer& buffer, bool for_device, std::uint64_t value) const;

  std::uint64_t counts_of(std::uint64_t ns) const;
  std::uint64_t now_ns() const;
  std::uint64_t interrupts() const;
  void sleep_until(std::uint64_t count);
  template <class Condition>
  void sleep_until(std::optional<std::uint64_t> count, Condition met);
  [[noreturn]] void fail(const std::string& problem) const;
  std::string place();

  static void print(const std::string& line);
  static void on_interrupt(void* uio);
  static void on_alarm(void* alarm);

  static LinuxRun* active;

  LinuxApplication application_;
  hal_program description_;
  Zynq* zynq_ = nullptr;
  CacheContract* caches_ = nullptr;
  std::optional<LinuxDevices> devices_;
  std::optional<LinuxFolder> folder_;

  drivers::Gic gic_;
  drivers::GlobalTimer timer_;
  std::uint64_t timer_hz_ = 0;
  volatile bool alarm_ = false;
  std::vector<Uio> uios_;
  std::vector<Buffer> buffers_;
  /// What the application may let devices access: its buffers, and what it maps of /dev/mem.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> memory_;  ///< [first, end)
  bool connected_ = false;                                       ///< the shim has said hello
  bool warned_of_parts_ = false;
  bool warned_of_uncleared_ = false;

  bool waits_ = false;                ///< the application, for an answer
  std::optional<std::string> place_;  ///< where it waits, once it was asked, or said so
};

}  // namespace platform
