#include <ps_gpio_registers.h>

#include <ps/gpio/gpio.h>

#include <stdexcept>
#include <string>

namespace ps {

namespace {

constexpr unsigned first_emio_bank = 2;
constexpr std::uint32_t outputs_only = 1u << 7 | 1u << 8;  // MIO pins 7 and 8

vp::RegisterBankOptions gpio_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

unsigned bank_of(unsigned pin) {
  unsigned bank = ps_gpio::bank_count - 1;
  while (ps_gpio::bank_first_pin[bank] > pin) --bank;
  return bank;
}

}  // namespace

Gpio::Gpio(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk)
    : vp::Clocked(name, cpu_1x_clk),
      registers("registers", ps_gpio::registers, gpio_options(), &cpu_1x_clk.scheduler()),
      outside_(ps_gpio::pin_count) {
  for (unsigned n = 0; n < ps_gpio::bank_count; ++n) banks_.push_back(bank_at(n));
  for (unsigned n = 0; n < ps_gpio::bank_count; ++n) wire_bank(n);
}

Gpio::Bank Gpio::bank_at(unsigned number) {
  const std::uint32_t at = number * ps_gpio::bank_stride;
  return {registers[ps_gpio::DATA_0 + number * ps_gpio::data_stride],
          registers[ps_gpio::DIRM_0 + at],
          registers[ps_gpio::OEN_0 + at],
          registers[ps_gpio::INT_MASK_0 + at],
          registers[ps_gpio::INT_STAT_0 + at],
          registers[ps_gpio::INT_TYPE_0 + at],
          registers[ps_gpio::INT_POLARITY_0 + at],
          registers[ps_gpio::INT_ANY_0 + at]};
}

void Gpio::wire_bank(unsigned number) {
  Bank& bank = banks_[number];
  const std::uint32_t at = number * ps_gpio::bank_stride;
  for (const unsigned half : {0u, 1u}) {
    vp::Register& masked = registers[ps_gpio::MASK_DATA_0_LSW + number * ps_gpio::mask_data_stride +
                                     half * sizeof(std::uint32_t)];
    const unsigned shift = 16 * half;
    masked.computed_by([&bank, shift] { return bank.data >> shift & 0xFFFF; });
    masked.after_write(
        [this, number, shift](std::uint32_t word) { write_masked(number, shift, word); });
  }
  if (number >= first_emio_bank) {
    bank.data.computed_by([this, &bank, number] {
      const std::uint32_t outputs = bank.dirm;
      return (bank.data & outputs) | (banks_[number].seen & ~outputs);
    });
  }
  registers[ps_gpio::DATA_0_RO + number * ps_gpio::data_stride].computed_by([this, number] {
    return number == 0 ? banks_[number].seen & ~outputs_only : banks_[number].seen;
  });
  for (vp::Register* r : {&bank.data, &bank.dirm, &bank.oen}) {
    r->after_write([this](std::uint32_t) { update_pins(); });
  }
  registers[ps_gpio::INT_EN_0 + at].after_write([this, &bank](std::uint32_t word) {
    bank.mask.clear_bits(word);
    update();
  });
  registers[ps_gpio::INT_DIS_0 + at].after_write([this, &bank, number](std::uint32_t word) {
    bank.mask.set_bits(word & ps_gpio::bank_mask[number]);
    update();
  });
  for (vp::Register* r : {&bank.stat, &bank.type, &bank.polarity, &bank.any}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
}

void Gpio::write_masked(unsigned number, unsigned shift, std::uint32_t word) {
  Bank& bank = banks_[number];
  const std::uint32_t chosen = (~word >> 16 & 0xFFFF) << shift & ps_gpio::bank_mask[number];
  bank.data = (bank.data & ~chosen) | ((word & 0xFFFF) << shift & chosen);
  update_pins();
}

// ---- the board

Gpio::Outside& Gpio::outside(unsigned pin) {
  if (pin >= ps_gpio::pin_count) {
    throw std::out_of_range("no pin " + std::to_string(pin) +
                            ": 0 to 53 are MIO, 54 to 117 are EMIO");
  }
  return outside_[pin];
}

void Gpio::set_pin(unsigned pin, bool level) {
  outside(pin) = {Outside::level, level, 0};
  update_pins();
}

void Gpio::release_pin(unsigned pin) {
  outside(pin) = {};
  update_pins();
}

void Gpio::connect_pins(unsigned from, unsigned to) {
  outside(from);
  outside(to) = {Outside::wire, false, from};
  update_pins();
}

void Gpio::set_pull_up(unsigned pin, bool on) {
  const std::uint64_t bit = std::uint64_t{1} << pin;
  pull_ups_ = on ? pull_ups_ | bit : pull_ups_ & ~bit;
  update_pins();
}

bool Gpio::pin(unsigned pin) const {
  if (pin >= ps_gpio::pin_count) const_cast<Gpio*>(this)->outside(pin);
  const unsigned bank = bank_of(pin);
  return banks_[bank].now >> (pin - ps_gpio::bank_first_pin[bank]) & 1;
}

std::uint32_t Gpio::driven(unsigned number) const {
  return banks_[number].dirm & banks_[number].oen;
}

// A ring of wires without a driver has the pull-up of its last pin.
bool Gpio::outside_level(unsigned pin, unsigned hops) const {
  const Outside& board = outside_[pin];
  if (board.kind == Outside::level) return board.high;
  const unsigned bank = bank_of(pin);
  if (board.kind == Outside::wire && hops < ps_gpio::pin_count) {
    const unsigned source = bank_of(board.from);
    const std::uint32_t bit = 1u << (board.from - ps_gpio::bank_first_pin[source]);
    if ((driven(source) & bit) != 0) return (banks_[source].data & bit) != 0;
    return outside_level(board.from, hops + 1);
  }
  if (bank < first_emio_bank) return pull_ups_ >> pin & 1;
  if (!emio_gpio_i.bound()) return false;
  return emio_gpio_i.read() >> (pin - ps_gpio::mio_pins) & 1;
}

// What leaves through the EMIO does not come back by itself: its inputs are other wires.
std::uint32_t Gpio::level_of(unsigned number) const {
  const Bank& bank = banks_[number];
  std::uint32_t level = number < first_emio_bank ? bank.data & driven(number) : 0;
  for (unsigned bit = 0; bit < 32; ++bit) {
    const unsigned pin = ps_gpio::bank_first_pin[number] + bit;
    if ((ps_gpio::bank_mask[number] >> bit & 1) == 0) continue;
    if (number < first_emio_bank && (driven(number) >> bit & 1) != 0) continue;
    level |= outside_level(pin, 0) ? 1u << bit : 0;
  }
  return level;
}

// ---- from the pins to the registers

void Gpio::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (emio_gpio_i.bound()) emio_gpio_i.signal()->attach(*this);
}

// What was on the pins before is no edge.
void Gpio::start_of_simulation() {
  update_pins();
  under_way_.clear();
  for (Bank& bank : banks_) bank.seen = bank.now;
  update();
}

void Gpio::on_change(vp::SignalBase&, std::uint32_t) {
  update_pins();
}

void Gpio::update_pins() {
  const auto both = [](unsigned low, auto word_of) {
    return static_cast<std::uint64_t>(word_of(low)) | static_cast<std::uint64_t>(word_of(low + 1))
                                                          << 32;
  };
  emio_gpio_o = both(2, [this](unsigned n) { return banks_[n].data.value(); });
  emio_gpio_t = ~both(2, [this](unsigned n) { return driven(n); });
  Change change{clock().cycle() + synchroniser_clocks, {}};
  bool changed = false;
  for (unsigned n = 0; n < ps_gpio::bank_count; ++n) {
    change.level[n] = level_of(n);
    changed |= change.level[n] != banks_[n].now;
    banks_[n].now = change.level[n];
  }
  mio_o = both(0, [this](unsigned n) { return banks_[n].now; });
  if (!changed) return;
  under_way_.push_back(change);
  wake_at(under_way_.front().due);
}

void Gpio::edge() {
  sleep();
  while (!under_way_.empty() && under_way_.front().due <= clock().cycle()) {
    take(under_way_.front().level);
    under_way_.pop_front();
  }
  if (!under_way_.empty()) wake_at(under_way_.front().due);
}

// Edges are found whether or not they are masked.
void Gpio::take(const std::array<std::uint32_t, 4>& level) {
  for (unsigned n = 0; n < ps_gpio::bank_count; ++n) {
    Bank& bank = banks_[n];
    const std::uint32_t rose = level[n] & ~bank.seen, fell = ~level[n] & bank.seen;
    const std::uint32_t wanted = (bank.any & (rose | fell)) |
                                 (~bank.any & ((bank.polarity & rose) | (~bank.polarity & fell)));
    bank.stat.set_bits(wanted & bank.type);
    bank.seen = level[n];
  }
  update();
}

// The status of a level comes back at once while the level holds.
void Gpio::update() {
  bool any = false;
  for (unsigned n = 0; n < ps_gpio::bank_count; ++n) {
    Bank& bank = banks_[n];
    bank.stat.set_bits(~bank.type & ~(bank.seen ^ bank.polarity) & ps_gpio::bank_mask[n]);
    any |= (bank.stat & ~bank.mask) != 0;
  }
  irq = any;
}

void Gpio::hold_in_reset(bool hold) {
  registers.hold_in_reset(hold);
  update_pins();
  update();
}

}  // namespace ps
