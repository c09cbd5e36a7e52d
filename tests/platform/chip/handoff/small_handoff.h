#pragma once

#include <string>
#include <vector>

/// Hand-offs of our own, in the form that Vivado writes.
namespace kit {

/// An attribute list: `name="value"` for each pair that has a value.
std::string element(const std::string& name,
                    const std::vector<std::pair<std::string, std::string>>& attributes,
                    const std::string& inside = "");

/// A pin. `more` are attributes as they are written: `SIGIS="clk" CLKFREQUENCY="100000000"`.
std::string pin(const std::string& direction, const std::string& name, const std::string& signal,
                unsigned width = 1, const std::string& more = "");
std::string parameter(const std::string& name, const std::string& value);
/// A bus interface of the kind "aximm" or "axis".
std::string bus(const std::string& type, const std::string& name, const std::string& bus_name,
                const std::string& kind = "aximm");
/// A segment of addresses of a master.
std::string segment(const std::string& master, const std::string& instance,
                    const std::string& slave, const std::string& base, const std::string& last,
                    const std::string& type = "REGISTER");

/// A block design: each call adds a module.
class HwhText {
 public:
  explicit HwhText(std::string name = "small") : name_(std::move(name)) {}

  HwhText& module(const std::string& instance, const std::string& vlnv,
                  const std::string& parameters, const std::string& pins,
                  const std::string& buses = "", const std::string& segments = "");
  /// A pin of the design.
  HwhText& external(const std::string& text);

  std::string arch = "zynq", device = "7z020";
  std::string text() const;

 private:
  std::string name_, modules_, external_;
};

/// A PS with FCLK_CLK0 of 100 MHz, M_AXI_GP0, S_AXI_HP0 and IRQ_F2P of three bits; an AXI GPIO of 4
/// bits at 0x4120'0000 with LEDs and an interrupt, an AXI DMA of a stream of 8 bits at 0x4040'0000
/// whose output is its input, an IP of the owner's at 0x43C0'0000, an MMCM that makes 74.25 MHz,
/// and two concats: IRQ_F2P is {DMA write, DMA read, GPIO}.
HwhText small_handoff();

/// `text` with `by` in the place of the first `what`, which must be there.
std::string replaced(std::string text, const std::string& what, const std::string& by);

}  // namespace kit
