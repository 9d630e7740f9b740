#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/quality/distribution.h"

namespace strataflow {

/// Text as HTML shows it: the five special characters are escaped.
std::string escaped_html(std::string_view text);

/// A number as a person reads it: six significant digits, or "unknown" for NaN.
std::string readable_number(double value);

/// A table; every cell is escaped. Columns that hold numbers are set to the right.
std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// A histogram as inline SVG, with its extremes and mean below.
std::string svg_histogram(const Distribution& distribution);

/// A curve through positive values, one per step, on a logarithmic scale, as inline SVG.
std::string svg_curve(const std::vector<double>& values, std::string_view caption);

/// A PNG picture inside the page, with a caption.
std::string html_picture(const std::vector<std::byte>& png, std::string_view caption);

/// The page around `body`, with its style; nothing is loaded from elsewhere.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace strataflow
