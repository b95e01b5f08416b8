#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace quadrille::bench {

/// Rows of text under named columns.
class Table {
  public:
    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// Throws Error if the row has another number of cells than the table has columns.
    void add(std::vector<std::string> row);

    void writeText(std::ostream& out) const;
    void writeCsv(std::ostream& out) const;
    void writeMarkdown(std::ostream& out) const;

  private:
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Stands in a cell that has no value.
inline constexpr std::string_view noValue = "-";

/// Four significant digits, more before the decimal point if there are.
std::string number(double value);
std::string hexadecimal(std::uint64_t value);

/// Where a table goes besides stdout; an empty name means nowhere.
struct TableFiles {
    std::string csv, markdown;
};

/// Opens the files (throws Error if that fails), so that a wrong name is found before a long run.
void checkWritable(const TableFiles& files);

/// Writes the table to stdout and to the files, the description of the machine before it and
/// `notes` after it.
void publish(const Table& table, const TableFiles& files, const std::vector<std::string>& notes);

}  // namespace quadrille::bench
