// SPDX-License-Identifier: BSD-3-Clause
// Friction of a strain-wave joint: the Stribeck curve at one temperature and the exponential law over
// temperature. Joint side, SI. Real-time safe. Source: Zhao (2006), (2-1)..(2-4) and (2-7)..(2-9).
#pragma once

namespace strainwave {

/// Friction at one temperature, joint side. All three are >= 0, and static_Nm >= coulomb_Nm for a physical joint.
struct FrictionParameters {
  double static_Nm = 0.0;        ///< Fs: largest torque that the joint at rest withstands.
  double coulomb_Nm = 0.0;       ///< Fc: friction of slow motion, beyond the Stribeck range.
  double viscous_Nms_rad = 0.0;  ///< Fv: slope over speed.

  bool operator==(const FrictionParameters&) const = default;
};

/// Shape of the transition from static to Coulomb friction; it does not change with temperature.
struct StribeckShape {
  double velocity_rad_s = 0.0;  ///< ws > 0, joint side.
  double exponent = 2.0;        ///< delta >= 0.5.
};

/// Friction torque in N.m that opposes a joint moving at `velocity_rad_s`, with the sign of the velocity:
///   F(w) = [ (Fs - Fc) exp(-(|w|/ws)^delta) + Fc + Fv |w| ] sign(w).
/// At w = 0 it returns 0: a joint at rest balances any torque up to Fs, which a model of the joint must handle.
double stribeck_friction_Nm(const FrictionParameters& friction, const StribeckShape& shape,
                            double velocity_rad_s) noexcept;

/// Friction over temperature, each parameter p(T) = p0 + p1 exp(-(T - T0)/Ts), clamped to be non-negative.
/// T0 and the three p1 are redundant (only p1 exp(T0/Ts) matters): compare curves, never parameters.
struct ExponentialTemperatureLaw {
  FrictionParameters asymptote;  ///< p0: the warm limit.
  FrictionParameters amplitude;  ///< p1: the part that vanishes as the joint warms.
  double reference_C = 0.0;      ///< T0.
  double decay_C = 1.0;          ///< Ts > 0.

  /// Friction at `temperature_C`.
  FrictionParameters at(double temperature_C) const noexcept;
};

/// Friction over temperature and speed.
struct FrictionLaw {
  ExponentialTemperatureLaw over_temperature;
  StribeckShape stribeck;
};

}  // namespace strainwave
