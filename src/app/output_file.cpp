#include "app/output_file.hpp"

#include <array>
#include <charconv>
#include <iostream>
#include <system_error>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

template <class Real>
std::string shortest(Real value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end};
}

}  // namespace

OutputFile::OutputFile(const std::string& name) : name_(name) {
    if (name_ == "-") return;
    temporary_ = name_ + ".part";
    file_.open(temporary_, std::ios::binary);
    if (!file_) throw Error(name_ + ": cannot be written");
}

OutputFile::~OutputFile() {
    if (committed_ || name_ == "-") return;
    file_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

std::ostream& OutputFile::stream() { return name_ == "-" ? std::cout : file_; }

void OutputFile::commit() {
    if (name_ == "-") {
        std::cout.flush();
        if (!std::cout) throw Error("stdout: cannot be written");
        return;
    }
    file_.close();
    if (!file_) throw Error(name_ + ": cannot be written");
    std::error_code error;
    std::filesystem::rename(temporary_, name_, error);
    if (error) throw Error(name_ + ": " + error.message());
    committed_ = true;
}

std::string exact(double value) { return shortest(value); }
std::string exact(float value) { return shortest(value); }

}  // namespace quadrille::app
