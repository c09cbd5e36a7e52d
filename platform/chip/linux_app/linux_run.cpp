#include <chip/linux_app/linux_run.h>

#include <cerrno>
#include <cstring>
#include <numeric>
#include <utility>

#include <gic_registers.h>
#include <ps/cpu/cpu.h>
#include <ps/cpu/program_watch.h>
#include <slcr_registers.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

namespace {

using linux_app::Device;
using linux_app::What;

enum Work : std::uint32_t { system_call, wake_up };
const char* const work_names[] = {"linux_system_call", "linux_wake_up"};

constexpr std::uint64_t ns_per_s = 1'000'000'000;
constexpr std::uint32_t timer_interrupt = 27;

std::uint32_t distributor(std::uint32_t offset) {
  return gic::distributor_base + offset;
}

/// Not where the host put things, which is elsewhere in each run.
std::string address_text(std::uint64_t address) {
  constexpr std::uint64_t first_page = 4096;
  if (address >> 32 != 0) return {};  // or it is not known
  return ": access to " + vp::hex(static_cast<std::uint32_t>(address)) +
         (address < first_page ? ", a null pointer" : "");
}

}  // namespace

void LinuxRun::print(const std::string& line) {
  hal_console_write((line + "\n").c_str(), line.size() + 1);
}

LinuxRun* LinuxRun::active = nullptr;

LinuxRun::LinuxRun(const LinuxOptions& options)
    : application_(options),
      description_{HAL_ABI,
                   application_.name().c_str(),
                   [] { return active->serve_to_end(); },
                   work_names,
                   std::size(work_names),
                   nullptr,
                   0,
                   nullptr,
                   0} {
  active = this;
}

LinuxRun::~LinuxRun() {
  active = nullptr;
}

ps::CostTable LinuxRun::costs(const ps::CostTable& costs) const {
  ps::CostTable all = costs;
  all.set(work_names[system_call], {static_cast<double>(devices_->system_call), 0});
  all.set(work_names[wake_up], {static_cast<double>(devices_->wake_up), 0});
  return all;
}

void LinuxRun::connect(Zynq& zynq, CacheContract& caches) {
  if (zynq.ps.ddr.descriptor() < 0)
    throw vp::InputError(
        "--linux: the application shares the DDR as a file without a name, and "
        "none of " +
        std::to_string(zynq.ps.ddr.size) +
        " B is allowed: raise 'ulimit -f', or choose a smaller ps.ddr.size");
  zynq_ = &zynq;
  caches_ = &caches;
  constexpr std::uint32_t all_at_the_top = 0x1F;  // U-Boot, arch/arm/mach-zynq/cpu.c
  zynq.ps.slcr.registers[slcr::OCM_CFG] = all_at_the_top;
  caches.check_owners(
      [this](std::uint64_t address, std::uint64_t bytes) { return owner_problem(address, bytes); });
  caches.name_calls("write 1 to sync_for_device", "write 1 to sync_for_cpu");
  devices_.emplace("linux", zynq);
  folder_.emplace();
  folder_->write("/dev/mem", "");
  zynq.ps.cpu.locate_program([this] { return place(); });
}

// Nothing here has a destructor that matters: a failure ends the program at once.
int LinuxRun::serve_to_end() {
  boot();
  ps::ProgramWatch::ends_itself = true;  // where the application is has to be asked first
  while (true) {
    using Stop = ps::ProgramWatch::Stop;
    if (ps::ProgramWatch::stop == Stop::host_time) {
      // In a call of the HAL, so that the watch does not leave it.
      ps::Cpu::running("a Linux application").guarded([&] {
        place_ = application_.end_for_time();
      });
    }
    if (ps::ProgramWatch::stop == Stop::host_time && application_.is_stopped())
      fail(
          "the application is stopped, by SIGSTOP or as it reads a terminal, and no process lets "
          "it continue: send it SIGCONT, or leave the stop out");
    if (ps::ProgramWatch::stop == Stop::host_time && application_.left_copy())
      fail(
          "the application's process has ended, and a copy of it that fork() made runs on and "
          "lets no simulated time pass: end it, or let it sleep or use a device");
    if (ps::ProgramWatch::stop != Stop::none) vp::FaultTrap::leave_at_stop();
    const std::optional<Asked> asked = application_.next();
    if (asked) {
      serve(*asked);
    } else if (application_.ended()) {
      return end();
    } else if (const std::optional<std::string> program = application_.replacement()) {
      fail(*program == application_.path()
               ? "the application closed the descriptor by which it reaches the platform with a "
                 "system call of its own, or started itself again, by exec(), which does not reach "
                 "the platform: call functions of the C library, and start it once"
               : "the application became another program, by exec(), which does not reach the "
                 "platform: start that one ('" +
                     *program + "'), with --linux");
    }
  }
}

void LinuxRun::boot() {
  gic_.initialise();
  timer_.initialise();
  timer_hz_ = zynq_->ps.cpu_clk.clk.frequency_hz() / drivers::GlobalTimer::cycles_per_count;
  gic_.connect(timer_interrupt, drivers::Trigger::rising_edge, &on_alarm, this);
  hal_interrupt_enable(true);
  make_uios();
  make_buffers();
  folder_->add(devices_->tree());
  // On the platform's side: the processes that guard it are copies of this one, where an exit is
  // not the program's.
  ps::Cpu::running("a Linux application").guarded([&] {
    application_.start(folder_->path(), zynq_->ps.ddr.descriptor(), &hal_console_write);
  });
}

void LinuxRun::make_uios() {
  const std::vector<LinuxDevices::Uio>& uios = devices_->uios();
  uios_.resize(uios.size());
  for (std::size_t i = 0; i < uios.size(); ++i) {
    folder_->add(uios[i], i);
    uios_[i].interrupt = uios[i].interrupt;
    uios_[i].enabled = true;
    if (uios[i].interrupt != 0)
      gic_.connect(uios[i].interrupt, drivers::Trigger::level_high, &on_interrupt, &uios_[i]);
    print("linux: /dev/uio" + std::to_string(i) + " is " + uios[i].device +
          (uios[i].interrupt != 0 ? ", interrupt " + std::to_string(uios[i].interrupt)
                                  : ", no interrupt") +
          ", at " + vp::hex(static_cast<std::uint32_t>(uios[i].base)));
  }
}

int LinuxRun::end() {
  const std::optional<LinuxApplication::Death> death = application_.death();
  if (death) {
    place_ = death->place;
    if (!death->reason.empty()) fail("the application " + death->reason);
    const char* const name = ::sigabbrev_np(death->signal);
    fail(std::string("the application was ended by SIG") + (name ? name : "?") + " (" +
         ::strsignal(death->signal) + ")" + address_text(death->address));
  }
  if (!connected_)
    fail("the application ended with exit code " + std::to_string(application_.exit_code()) +
         " before the shim was loaded into it: its loader says why, above, or its C library is not "
         "glibc");
  return application_.exit_code();
}

void LinuxRun::fail(const std::string& problem) const {
  ps::Cpu& cpu = ps::Cpu::running("a Linux application");
  cpu.guarded([&] { cpu.misuse(problem); });
  std::abort();  // it does not come back
}

// Asked once for each request: each look at the stack takes the host's time.
std::string LinuxRun::place() {
  if (!place_ && !waits_) return {};
  if (!place_) place_ = application_.place();
  return *place_;
}

void LinuxRun::serve(const Asked& asked) {
  place_.reset();
  if (asked.request.what == What::failure) {
    const std::size_t end = asked.text.find('\n');
    place_ = end == std::string::npos ? "" : asked.text.substr(end + 1);
    fail(asked.text.substr(0, end));
  }
  waits_ = true;
  Reply reply{};
  obey(asked, reply);
  for (std::size_t i = 0; i < uios_.size(); ++i) reply.interrupts[i] = uios_[i].count;
  waits_ = false;
  application_.answer(reply);
}

void LinuxRun::obey(const Asked& asked, Reply& reply) {
  const Request& request = asked.request;
  const auto address = static_cast<std::uint32_t>(request.a);
  switch (request.what) {
    case What::read:
      reply.a = read(address, request.size);
      return;
    case What::write:
      return write(address, static_cast<std::uint32_t>(request.b), request.size);
    case What::clock:  // without a call of the kernel: vdso(7)
      reply.now_ns = now_ns();
      return;
    case What::hello:
      connected_ = true;
      reply.a = ps::Ddr::base;
      reply.b = zynq_->ps.ddr.end();
      return;
    default:
      hal_work(system_call, 1);
  }
  switch (request.what) {
    case What::open:
      return open(request, reply);
    case What::map:
      return map(request);
    case What::interrupt:
      if (has_interrupt(request.a, reply))
        reply.a = await_interrupt(request.a, static_cast<std::uint32_t>(request.b), request.c != 0);
      return;
    case What::control:
      if (has_interrupt(request.a, reply)) control(uios_.at(request.a), request.b != 0);
      return;
    case What::sleep:
      if (request.a != 0) sleep_until(timer_.now() + counts_of(request.a));
      return;
    case What::wait: {
      const std::uint64_t before = now_ns();
      if (before < request.a && interrupts() == request.b) {
        const auto end = request.a == linux_app::forever
                             ? std::nullopt
                             : std::optional<std::uint64_t>(counts_of(request.a));
        sleep_until(end, [&] { return interrupts() != request.b; });
      }
      reply.now_ns = now_ns();
      return;
    }
    case What::missing:
      print("linux: " + asked.text + " is not there: those that are stand above");
      return;
    case What::refused:
      hal_warn(asked.text.c_str());
      return;
    case What::store:
      reply.error = store(buffers_.at(request.a), request.a, asked.text);
      return;
    default:
      return;
  }
}

void LinuxRun::open(const Request& request, Reply& reply) {
  if (static_cast<Device>(request.a) == Device::uio) {
    const LinuxDevices::Uio& uio = devices_->uios().at(request.b);
    reply.a = uio.base;
    reply.b = uio.size;
    reply.error = uio.interrupt != 0 ? 0 : EIO;
  } else if (static_cast<Device>(request.a) == Device::buffer) {
    reply.a = buffers_.at(request.b).base;
    reply.b = buffers_.at(request.b).size;
  }
}

void LinuxRun::note_access(std::uint32_t address) {
  for (std::size_t i = 0; i < uios_.size(); ++i) {
    const LinuxDevices::Uio& uio = devices_->uios()[i];
    if (address >= uio.base && address - uio.base < uio.size) uios_[i].touched = true;
  }
}

std::uint32_t LinuxRun::read(std::uint32_t address, std::uint32_t size) {
  note_access(address);
  const std::uint32_t word = hal_read32(address & ~3u) >> (address & 3) * 8;
  return size == 4 ? word : word & ((1u << size * 8) - 1);
}

void LinuxRun::write(std::uint32_t address, std::uint32_t value, std::uint32_t size) {
  note_access(address);
  if (size == 4) return hal_write32(address, value);
  if (!std::exchange(warned_of_parts_, true)) {
    hal_warn(("a write of " + std::to_string(size) + (size == 1 ? " byte" : " bytes") + " to " +
              vp::hex(address) +
              ": devices like AXI GPIO and AXI DMA take whole words on the chip, whatever part is "
              "meant, and here the rest of the word is read and written back: write a uint32_t")
                 .c_str());
  }
  const std::uint32_t shift = (address & 3) * 8, mask = ((1u << size * 8) - 1) << shift;
  const std::uint32_t before = hal_read32(address & ~3u);
  hal_write32(address & ~3u, (before & ~mask) | (value << shift & mask));
}

/// As drivers/uio/uio.c answers for a device without one.
bool LinuxRun::has_interrupt(std::size_t number, Reply& reply) {
  if (uios_.at(number).interrupt != 0) return true;
  reply.error = EIO;
  const LinuxDevices::Uio& uio = devices_->uios()[number];
  hal_warn(("read() and write() of /dev/uio" + std::to_string(number) + " give EIO: " + uio.device +
            " has no interrupt at the PS")
               .c_str());
  return false;
}

// As uio_pdrv_genirq: an interrupt masks itself, and its handler unmasks it again.
void LinuxRun::on_interrupt(void* context) {
  Uio& uio = *static_cast<Uio*>(context);
  if (!uio.touched)
    active->warn_of_uncleared(static_cast<std::size_t>(&uio - active->uios_.data()));
  uio.touched = false;
  ++uio.count;
  uio.enabled = false;
  hal_write32(distributor(gic::ICDICER(uio.interrupt / 32)), 1u << uio.interrupt % 32);
}

void LinuxRun::control(Uio& uio, bool enable) {
  if (uio.enabled == enable) return;
  uio.enabled = enable;
  const std::uint32_t number = uio.interrupt / 32;
  hal_write32(distributor(enable ? gic::ICDISER(number) : gic::ICDICER(number)),
              1u << uio.interrupt % 32);
}

std::uint32_t LinuxRun::await_interrupt(std::size_t number, std::uint32_t seen, bool waits) {
  const Uio& uio = uios_.at(number);
  if (!waits || uio.count != seen) {
    hal_barrier();
    return uio.count;
  }
  warn_of_masked(number);
  sleep_until(std::nullopt, [&] { return uio.count != seen; });
  return uio.count;
}

void LinuxRun::warn_of_masked(std::size_t number) const {
  if (uios_[number].enabled) return;
  const std::string file = "/dev/uio" + std::to_string(number);
  hal_warn(
      ("the application waits for an interrupt of " + file +
       ", which is masked: each one masks it, and so does writing 0; write 1 (a uint32_t) to " +
       file + " before it waits")
          .c_str());
}

void LinuxRun::warn_of_uncleared(std::size_t number) {
  if (std::exchange(warned_of_uncleared_, true)) return;
  const std::string file = "/dev/uio" + std::to_string(number);
  const std::string device = devices_->uios()[number].device;
  hal_warn((file + " interrupts again, and the application has not accessed " + device +
            " since its last interrupt: the line is still high, so that read() returns at once, "
            "whatever the device does; clear the interrupt in the registers of " +
            device + " before 1 is written to " + file)
               .c_str());
}

void LinuxRun::on_alarm(void* context) {
  LinuxRun& self = *static_cast<LinuxRun*>(context);
  self.timer_.clear_alarm();
  self.alarm_ = true;
}

std::uint64_t LinuxRun::counts_of(std::uint64_t ns) const {
  using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((Wide{ns} * timer_hz_ + ns_per_s - 1) / ns_per_s);
}

std::uint64_t LinuxRun::now_ns() const {
  using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(Wide{timer_.now()} * ns_per_s / timer_hz_);
}

std::uint64_t LinuxRun::interrupts() const {
  return std::accumulate(uios_.begin(), uios_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Uio& uio) { return sum + uio.count; });
}

void LinuxRun::sleep_until(std::uint64_t count) {
  sleep_until(count, [] { return false; });
}

/// Until the timer has counted so far, if it is to end so, or `met` holds.
template <class Condition>
void LinuxRun::sleep_until(std::optional<std::uint64_t> count, Condition met) {
  alarm_ = false;
  if (count) timer_.set_alarm(*count);
  hal_interrupt_enable(false);
  while (!alarm_ && !met()) {
    hal_wait_for_interrupt();
    hal_interrupt_enable(true);
    hal_interrupt_enable(false);
  }
  hal_interrupt_enable(true);
  if (count && !alarm_) timer_.clear_alarm();
  hal_work(wake_up, 1);
}

}  // namespace platform
