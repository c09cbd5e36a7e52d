#pragma once

#include <chip/system/design.h>
#include <vp/parameter.h>

#include <string>

#include "fir_design.h"

/// The filter of examples/08_filter on a ramp that its program makes; it may declare or report too
/// little, or too much.
class MistakenFir : public FirDesign {
 public:
  MistakenFir(sc_core::sc_module_name name, platform::PlPorts& ports);

  platform::facts::Work work() const override;
  bool report(const platform::Publication& publication,
              platform::facts::UnitReport& block) override;

 private:
  vp::Parameter<std::string> mistake_;
};

/// "ramp".
const platform::DesignInfo& ramp_design();
