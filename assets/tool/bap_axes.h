#pragma once
// --bap-axes: how the BAPs of a file turn joints; nothing in it tells.
#include <CLI/CLI.hpp>
#include <string>

#include "core/body/bap_axes.h"

namespace caryatid::tool {

inline void add_bap_axes(CLI::App* cmd, std::string* name) {
  cmd->add_option(
         "--bap-axes", *name,
         "How the BAPs of a file turn joints: signed (default), reversed, plain (all about "
         "the positive axes)")
      ->check(CLI::IsMember({"signed", "reversed", "plain"}));
}

// name: one of add_bap_axes().
inline body::BapConvention bap_axes_named(const std::string& name) {
  if (name == "plain") return body::BapConvention::plain_axes;
  return name == "reversed" ? body::BapConvention::signed_axes_reversed
                            : body::BapConvention::signed_axes;
}

}  // namespace caryatid::tool
