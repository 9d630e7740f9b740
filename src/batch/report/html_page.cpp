#include "batch/report/html_page.h"

#include <algorithm>
#include <limits>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace strataflow {

namespace {

constexpr std::string_view style = R"(
body { font: 15px/1.5 system-ui, sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
h1 { font-weight: 600; margin-bottom: 0; } h2 { margin-top: 2em; border-bottom: 1px solid #ccc; font-weight: 600; }
table { border-collapse: collapse; margin: 1em 0; } th, td { padding: .2em .8em; border-bottom: 1px solid #e4e4e4; text-align: left; vertical-align: top; }
th { font-weight: 600; background: #f4f4f2; } td.n { text-align: right; font-variant-numeric: tabular-nums; }
.ok { color: #1a7f37; } .failed { color: #b3261e; } .note { color: #666; }
.row { display: flex; flex-wrap: wrap; gap: 1.5em; } figure { margin: 0; } figure img { max-width: 100%; border: 1px solid #ddd; }
figcaption { color: #555; font-size: .9em; } code { font-size: .9em; word-break: break-all; }
)";

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.+-e") == std::string::npos &&
         text.find_first_of("0123456789") != std::string::npos;
}

std::string base64(const std::vector<std::byte>& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string formatted(const char* format, double value) {
  std::array<char, 64> text;
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), format, value))};
}

}  // namespace

std::string escaped_html(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string readable_number(double value) { return std::isnan(value) ? "unknown" : formatted("%.6g", value); }

std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<table>\n";
  if (!header.empty()) {
    html += "<tr>";
    for (const std::string& title : header) html += "<th>" + escaped_html(title) + "</th>";
    html += "</tr>\n";
  }
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row)
      html += (is_number(cell) ? "<td class=\"n\">" : "<td>") + escaped_html(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string svg_histogram(const Distribution& distribution) {
  constexpr double width = 300, height = 110;
  const std::uint64_t highest =
      distribution.bins.empty() ? 0 : *std::max_element(distribution.bins.begin(), distribution.bins.end());
  std::string svg = "<figure><svg width=\"320\" height=\"140\" role=\"img\"><g transform=\"translate(10,5)\">\n";
  const double step = distribution.bins.empty() ? width : width / static_cast<double>(distribution.bins.size());
  for (std::size_t i = 0; i < distribution.bins.size() && highest > 0; ++i) {
    const double bar = height * static_cast<double>(distribution.bins[i]) / static_cast<double>(highest);
    svg += "<rect x=\"" + formatted("%.2f", step * static_cast<double>(i)) + "\" y=\"" +
           formatted("%.2f", height - bar) + "\" width=\"" + formatted("%.2f", 0.9 * step) + "\" height=\"" +
           formatted("%.2f", bar) + "\" fill=\"#4878a8\"/>\n";
  }
  svg +=
      "<line x1=\"0\" y1=\"110\" x2=\"300\" y2=\"110\" stroke=\"#888\"/>\n<text x=\"0\" y=\"126\" font-size=\"11\">" +
      readable_number(distribution.low) + "</text><text x=\"300\" y=\"126\" font-size=\"11\" text-anchor=\"end\">" +
      readable_number(distribution.high) + "</text></g></svg>\n";
  return svg + "<figcaption>" + escaped_html(distribution.name) + ": " + readable_number(distribution.minimum) + " … " +
         readable_number(distribution.maximum) + ", mean " + readable_number(distribution.mean()) + ", " +
         std::to_string(distribution.count) + " values</figcaption></figure>\n";
}

std::string svg_curve(const std::vector<double>& values, std::string_view caption) {
  constexpr double width = 300, height = 110;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values)
    if (value > 0) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  std::string svg = "<figure><svg width=\"320\" height=\"140\" role=\"img\"><g transform=\"translate(10,5)\">\n";
  if (high > 0) {
    const double range = high > low ? std::log(high / low) : 1;
    const double step = values.size() > 1 ? width / static_cast<double>(values.size() - 1) : 0;
    svg += "<polyline fill=\"none\" stroke=\"#4878a8\" points=\"";
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] > 0)
        svg += formatted("%.2f", step * static_cast<double>(i)) + "," +
               formatted("%.2f", height * (1 - std::log(values[i] / low) / range)) + " ";
    svg += "\"/>\n<text x=\"300\" y=\"10\" font-size=\"11\" text-anchor=\"end\">" + readable_number(high) +
           "</text><text x=\"0\" y=\"108\" font-size=\"11\">" + readable_number(low) + "</text>";
  }
  svg += "<line x1=\"0\" y1=\"110\" x2=\"300\" y2=\"110\" stroke=\"#888\"/></g></svg>\n";
  return svg + "<figcaption>" + escaped_html(caption) + ", " + std::to_string(values.size()) +
         " steps</figcaption></figure>\n";
}

std::string html_picture(const std::vector<std::byte>& png, std::string_view caption) {
  const std::string text = escaped_html(caption);
  return "<figure><img alt=\"" + text + "\" src=\"data:image/png;base64," + base64(png) + "\"><figcaption>" + text +
         "</figcaption></figure>\n";
}

std::string html_page(std::string_view title, std::string_view body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\">\n<title>" +
         escaped_html(title) + "</title>\n<style>" + std::string(style) + "</style></head>\n<body>\n" +
         std::string(body) + "</body>\n</html>\n";
}

}  // namespace strataflow
