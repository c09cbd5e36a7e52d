#pragma once

namespace vp {

/// How hot a chip gets: junction = ambient + theta_ja · power, once temperatures have settled.
struct ThermalPath {
  double ambient_c = 25;
  double theta_ja = 0;  ///< °C/W
};

/// Power that flows without any clock: base + leakage · exp(slope · (Tj − 25 °C)).
struct LeakageCurve {
  double base_w = 0;
  double leakage_w = 0;  ///< at 25 °C
  double slope = 0;      ///< 1/°C

  double watts(double junction_c) const;
};

/// Where temperature and static power agree.
struct StaticPoint {
  double junction_c = 0;
  double static_w = 0;
};

/// Static power heats, and heat makes static power: the fixed point of both at `dynamic_w`, found
/// from below, so it is the stable one. Throws InputError for thermal runaway: there is none.
StaticPoint find_static_point(const LeakageCurve& leakage, const ThermalPath& path,
                              double dynamic_w);

}  // namespace vp
