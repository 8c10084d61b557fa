#pragma once
/** @file
Numbers as text, the same on every machine and in every locale. Units stand in table heads; what is
missing (not finite) is "n/a", never a plausible number. */

#include <string>

namespace graspbench {

/** A fixed number of decimals: FormatFixed(0.0123, 3) = "0.012". Never "-0". */
std::string FormatFixed(double value, int decimals);

/** Significant digits: FormatSignificant(0.001234, 3) = "0.00123"; very small or large numbers in
the form "1.23e-07". */
std::string FormatSignificant(double value, int digits);

/** A ratio as per cent with one decimal and the sign after a no-break space: FormatPercent(0.9) =
"90.0 %". */
std::string FormatPercent(double ratio);

/** "1 trial", "2 trials". */
std::string FormatCount(int count, const std::string& singular);

/** A rate as it must be printed, with its counts and Wilson interval: "9 of 10 trials (90.0 %,
95 % interval 59.6 to 98.2 %)"; "0 of 0 trials" without any. */
std::string FormatRate(int successes, int n);

/** The interval alone, in per cent: "59.6 to 98.2"; "n/a" without trials. */
std::string FormatRateInterval(int successes, int n);

}  // namespace graspbench
