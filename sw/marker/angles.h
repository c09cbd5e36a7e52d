#pragma once

namespace marker {

// From + - * / and the square root alone, so that host and chip agree in every bit.

/// tan(angle) for an angle from 0 to 1.5 rad. Relative error below 1e-13.
double tangent(double angle);

/// The angle from 0 to π/2, rad, whose tangent is `slope`, which is not negative. Absolute error
/// below 1e-15.
double angle_of(double slope);

/// `base` to the power of `exponent`, for a base in (0, 1] and an exponent in [0, 8]. Relative
/// error below 1e-12.
double power(double base, double exponent);

/// Natural logarithm of a positive number between 1e-6 and 1e6. Absolute error below 1e-14.
double logarithm(double x);

/// e to the power of x, x in [-60, 60]. Relative error below 1e-13.
double exponential(double x);

}  // namespace marker
