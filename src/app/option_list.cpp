#include "app/option_list.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <quadrille/version.hpp>

namespace quadrille::app {

namespace {

/// As roff has it: a hyphen that stays one, and no line that could be a request.
std::string roff(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '-' || c == '\\') escaped += '\\';
        escaped += c == '\\' ? std::string("e") : std::string(1, c);
    }
    if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
    return escaped;
}

/// Its names as they are typed: "--law", "-h".
std::vector<std::string> namesOf(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

std::string join(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// The type of an option's value and, of one of a few values, those: "NAME" and "a b" of the
/// "NAME:{a,b}" that CLI11 makes of type and check.
struct ValueKind {
    std::string type;
    std::string values;
};

ValueKind valueOf(const CLI::Option& option) {
    const std::string text = option.get_type_name();
    const std::size_t open = text.find('{'), close = text.find('}');
    ValueKind kind{text.substr(0, text.find(':')), {}};
    if (open != std::string::npos && close != std::string::npos) {
        kind.values = text.substr(open + 1, close - open - 1);
        std::replace(kind.values.begin(), kind.values.end(), ',', ' ');
    }
    return kind;
}

bool takesValue(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

}  // namespace

void writeManual(std::ostream& out, const CLI::App& app) {
    out << ".TH COLLISIONSTRESS 1 \"\" \"Quadrille " << version << "\" \"User Commands\"\n"
        << ".SH NAME\n"
        << app.get_name() << " \\- " << roff(app.get_description()) << '\n'
        << ".SH SYNOPSIS\n.B " << app.get_name() << "\n[\\fIOPTION\\fR]... [\\fISCENE\\fR]\n"
        << ".SH OPTIONS\n";
    for (const std::string& group : app.get_groups()) {
        if (group.empty()) continue;  // hidden ones
        out << ".SS " << roff(group) << '\n';
        for (const CLI::Option* option : app.get_options()) {
            if (option->get_group() != group || option->get_lnames().empty()) continue;
            out << ".TP\n\\fB" << roff(join(namesOf(*option), ", ")) << "\\fR";
            if (takesValue(*option)) out << " \\fI" << roff(valueOf(*option).type) << "\\fR";
            out << '\n' << roff(option->get_description());
            if (const std::string preset = option->get_default_str(); !preset.empty()) {
                out << " (" << roff(preset) << ')';
            }
            out << '\n';
        }
    }
    out << ".SH EXIT STATUS AND OUTPUT\n";
    std::istringstream footer(app.get_footer());
    for (std::string line; std::getline(footer, line);) out << roff(line) << "\n.br\n";
}

void writeBashCompletion(std::ostream& out, const CLI::App& app) {
    out << "# Written by " << app.get_name() << " --generate complete-bash\n"
        << "_" << app.get_name() << R"sh(() {
    local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    # bash takes --option=value for three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    local words= files= scenes= listed=
    case $previous in
)sh";
    std::vector<std::string> all, free;
    for (const CLI::Option* option : app.get_options()) {
        const std::vector<std::string> names = namesOf(*option);
        all.insert(all.end(), names.begin(), names.end());
        if (!takesValue(*option)) continue;
        const auto [type, values] = valueOf(*option);
        const bool isFile = type.ends_with("FILE");
        if (!isFile && values.empty()) {
            free.insert(free.end(), names.begin(), names.end());
            continue;
        }
        out << "        " << join(names, " | ") << ")";
        if (isFile) out << " files=1";
        if (option->get_positional()) out << " scenes=1";
        if (!values.empty()) out << " words='" << values << "'";
        if (option->get_delimiter() != '\0') out << " listed=1";
        out << " ;;\n";
    }
    out << "        " << join(free, " | ") << ") return ;;\n"
        << R"sh(        *) if [[ $cur == -* ]]; then words=')sh" << join(all, " ") << R"sh('
            else files=1 scenes=1; fi ;;
    esac
    [[ $scenes ]] && words+=" $("$1" --list 2>/dev/null | sed -n 's/^scenes: //p')"
    # Of values with commas between them, the last.
    local before=
    [[ $listed && $cur == *,* ]] && before=${cur%,*},
    COMPREPLY=($(compgen -P "$before" -W "$words" -- "${cur#"$before"}"))
    if [[ $files ]]; then
        compopt -o filenames 2>/dev/null
        local IFS=$'\n'
        COMPREPLY+=($(compgen -f -- "$cur"))
    fi
}
)sh"
        << "complete -F _" << app.get_name() << ' ' << app.get_name() << '\n';
}

}  // namespace quadrille::app
