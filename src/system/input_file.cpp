#include "system/input_file.hpp"

#include <cerrno>
#include <system_error>

#include <quadrille/error.hpp>

#include "system/descriptor.hpp"

namespace quadrille {

std::string readRegularFile(const std::filesystem::path& file, std::uint64_t mostBytes) {
    const auto because = [](const char* what, int error) {
        return Error(std::string(what) + ": " + std::generic_category().message(error));
    };
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) throw Error("is a folder");
    const Descriptor in = openForReading(file);
    if (!in) throw because("cannot be opened", errno);
    const FileState state = stateOf(in);
    if (!state.regular) throw Error("is not a regular file");
    if (state.bytes > mostBytes) {
        throw Error("has " + std::to_string(state.bytes) + " bytes, more than the " +
                    std::to_string(mostBytes) + " that can be read");
    }
    std::string content(static_cast<std::size_t>(state.bytes), '\0');
    std::size_t done = 0;
    if (const int error = readAll(in.get(), content.data(), content.size(), done)) {
        throw because("cannot be read", error);
    }
    if (done < content.size()) throw Error("became shorter while it was read");
    return content;
}

void dropByteOrderMark(std::string& text) {
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
}

}  // namespace quadrille
