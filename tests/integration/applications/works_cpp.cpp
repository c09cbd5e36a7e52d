// The same in C++: streams, threads' sleep, clocks.
#include <fcntl.h>
#include <sys/mman.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

namespace {

const std::string buffer = "/sys/class/u-dma-buf/udmabuf0/";

std::string read(const std::string& file) {
  std::string text;
  std::ifstream(file) >> text;
  return text;
}

template <class Condition>
void expect(Condition condition, const char* what) {
  if (condition) return;
  std::cout << "not so: " << what << std::endl;
  std::exit(1);
}

class Gpio {
 public:
  Gpio()
      : registers_(static_cast<volatile std::uint32_t*>(mmap(nullptr, 4096, PROT_READ | PROT_WRITE,
                                                             MAP_SHARED, open("/dev/mem", O_RDWR),
                                                             0x41200000))) {}
  volatile std::uint32_t& operator[](int i) { return registers_[i]; }

 private:
  volatile std::uint32_t* registers_;
};

}  // namespace

int main(int count, char**) {
  expect(std::filesystem::exists("/dev/udmabuf0"), "there is a buffer");
  unsigned uios = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/sys/class/uio"))
    uios += entry.path().filename().string().rfind("uio", 0) == 0;
  expect(uios == 4, "four uios");
  expect(read("/sys/class/uio/uio0/name") == "dma", "its name");
  std::ofstream(buffer + "sync_direction") << 2 << std::endl;
  expect(read(buffer + "sync_direction") == "2", "what was written");
  std::ofstream wrong(buffer + "sync_direction");
  wrong << 7 << std::flush;
  expect(!wrong, "three directions");

  using Clock = std::chrono::steady_clock;
  const auto before = Clock::now();
  std::this_thread::sleep_for(std::chrono::microseconds(250));
  const auto passed = Clock::now() - before;
  expect(passed >= std::chrono::microseconds(250) && passed < std::chrono::microseconds(280),
         "250 us");
  Gpio gpio;
  gpio[1] = 0;
  if (count > 1) gpio[1000] = 0;
  return 0;
}
