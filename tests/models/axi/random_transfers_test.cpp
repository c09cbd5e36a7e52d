// Random transfers through both adapters, against a copy of the memory: any address, length, byte
// enables and streaming width, at every width of the bus, with back-pressure on all channels.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "adapter_bench.h"

namespace {

/// Transfers of one run. MARKERVP_TRANSFERS=1000000 is the whole acceptance.
unsigned transfers() {
  const char* wanted = std::getenv("MARKERVP_TRANSFERS");
  return wanted ? static_cast<unsigned>(std::stoul(wanted)) : 2'000;
}

/// A transfer as a memory sees it that knows no bus.
void move(std::vector<unsigned char>& memory, bool read, std::uint64_t address,
          std::vector<unsigned char>& data, unsigned width,
          const std::vector<unsigned char>& enables) {
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (!enables.empty() && enables[i % enables.size()] != TLM_BYTE_ENABLED) continue;
    unsigned char& byte = memory[address + i % width];
    (read ? data[i] : byte) = read ? byte : data[i];
  }
}

void run(const axi::Shape& shape, bool stalls, bool direct) {
  kit::AdapterBench bench(shape, stalls);
  bench.memory.direct = direct;
  std::vector<unsigned char> expected = bench.memory.bytes;
  vp::RandomBits random(shape.data_bytes + (stalls ? 1 : 0));
  const auto below = [&](std::uint64_t limit) { return random.next() % limit; };
  unsigned wrong = 0;
  bench.software.simulate([&] {
    for (unsigned n = 0; n < transfers() && wrong == 0; ++n) {
      const bool read = below(2) != 0;
      const auto length = static_cast<unsigned>(1 + below(below(8) == 0 ? 300 : 40));
      const std::uint64_t address = below(kit::AdapterBench::memory_size - length);
      const auto width = static_cast<unsigned>(below(4) == 0 ? 1 + below(length) : length);
      std::vector<unsigned char> data(length), enables(below(3) == 0 ? 1 + below(length) : 0);
      for (unsigned char& byte : data) byte = static_cast<unsigned char>(random.next());
      for (unsigned char& byte : enables) byte = below(2) ? TLM_BYTE_ENABLED : TLM_BYTE_DISABLED;
      std::vector<unsigned char> copy = data;
      move(expected, read, address, copy, width, enables);
      bench.software.prepare(read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND, address,
                             data.data(), length);
      bench.software.payload.set_streaming_width(width);
      if (!enables.empty()) {
        bench.software.payload.set_byte_enable_ptr(enables.data());
        bench.software.payload.set_byte_enable_length(static_cast<unsigned>(enables.size()));
      }
      bench.software.send();
      if (bench.software.response() == tlm::TLM_OK_RESPONSE && data == copy) continue;
      ++wrong;
      BOOST_ERROR("transfer " << n << ": " << (read ? "read of " : "write of ") << length
                              << " bytes at " << address << ", width " << width);
    }
  });
  BOOST_TEST((bench.memory.bytes == expected));
}

}  // namespace

BOOST_AUTO_TEST_CASE(axi4_of_every_width_moves_the_right_bytes) {
  for (const unsigned bytes : {4u, 8u, 128u}) {
    axi::Shape shape;
    shape.data_bytes = bytes;
    run(shape, false, bytes != 8);
    run(shape, true, bytes == 8);
  }
}

BOOST_AUTO_TEST_CASE(axi3_and_axi4_lite_move_the_right_bytes) {
  axi::Shape axi3;
  axi3.burst_beats = 16;
  run(axi3, true, true);
  axi::Shape lite;
  lite.lite = true;
  lite.burst_beats = 1;
  run(lite, true, false);
}
