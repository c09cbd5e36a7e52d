#include <marker/angles.h>

#include <cmath>

namespace marker {

double tangent(double angle) {
  // Taylor's series of sine and cosine together.
  constexpr int terms = 28;
  double sine = 0, cosine = 0, term = 1;
  for (int n = 0; n < terms; n += 2) {
    cosine += term;
    term *= angle / (n + 1);
    sine += term;
    term *= -angle / (n + 2);
  }
  return sine / cosine;
}

double angle_of(double slope) {
  // Three times the half of the angle, whose tangent is then below 0.2.
  constexpr int halvings = 3, terms = 13;
  double t = slope;
  for (int i = 0; i < halvings; ++i) {
    // Beyond this the square would overflow, and the half's tangent is 1 to the last bit.
    constexpr double steep = 1e17;
    t = t > steep ? 1 : t / (1 + std::sqrt(1 + t * t));
  }
  double sum = 0;
  const double square = t * t;
  for (int n = terms - 1; n >= 0; --n) sum = 1.0 / (2 * n + 1) - square * sum;
  return (1 << halvings) * t * sum;
}

double logarithm(double x) {
  constexpr double of_two = 0.69314718055994530942;
  int doublings = 0;
  for (; x > 1.5; x /= 2) ++doublings;
  for (; x < 0.75; x *= 2) --doublings;
  // 2 artanh of a number below 0.2.
  constexpr int terms = 12;
  const double t = (x - 1) / (x + 1), square = t * t;
  double sum = 0;
  for (int n = terms - 1; n >= 0; --n) sum = 1.0 / (2 * n + 1) + square * sum;
  return doublings * of_two + 2 * t * sum;
}

double exponential(double x) {
  // (e^(x/2^9))^(2^9)
  constexpr int squarings = 9, terms = 9;
  const double small = x / (1 << squarings);
  double sum = 1;
  for (int n = terms; n >= 1; --n) sum = 1 + small / n * sum;
  for (int i = 0; i < squarings; ++i) sum *= sum;
  return sum;
}

double power(double base, double exponent) {
  return exponential(exponent * logarithm(base));
}

}  // namespace marker
