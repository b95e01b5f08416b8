#include "app/one_of.hpp"

#include <utility>

#include <quadrille/names.hpp>

namespace quadrille::app {

CLI::Validator oneOf(std::vector<std::string> names) {
    const CLI::Validator member = CLI::IsMember(names);
    return CLI::Validator(
        [member, names = std::move(names)](std::string& text) {
            const std::string error = member(text);
            return error.empty() ? error : error + didYouMean(nearestNames(text, names));
        },
        member.get_description());
}

}  // namespace quadrille::app
