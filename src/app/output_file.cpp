#include "app/output_file.hpp"

#include <array>
#include <charconv>
#include <iostream>
#include <system_error>

#include <quadrille/error.hpp>

#include "app/standard_streams.hpp"

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
    if (name_ == "-") {
        requireStdout();
        return;
    }
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(name_, error);
    if (fs::is_directory(status)) throw Error(name_ + ": is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        file_.open(name_, std::ios::binary);
    } else {
        target_ = name_;
        if (fs::is_symlink(target_, error) && fs::exists(status)) target_ = fs::canonical(target_);
        temporary_ = target_;
        temporary_ += ".part";
        file_.open(temporary_, std::ios::binary);
    }
    if (!file_) throw Error(name_ + ": cannot be written");
}

OutputFile::~OutputFile() {
    if (committed_ || temporary_.empty()) return;
    file_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

std::ostream& OutputFile::stream() { return name_ == "-" ? std::cout : file_; }

void OutputFile::commit() {
    if (name_ == "-") {
        finishStdout();
        return;
    }
    file_.close();
    if (!file_) throw Error(name_ + ": cannot be written");
    if (temporary_.empty()) return;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw Error(name_ + ": " + error.message());
    committed_ = true;
}

std::string exact(double value) { return shortest(value); }
std::string exact(float value) { return shortest(value); }

}  // namespace quadrille::app
