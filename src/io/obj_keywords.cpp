#include "io/obj_keywords.h"

#include <algorithm>
#include <array>

namespace asdfvk {
namespace {

// In ASCII order, which the binary search needs.
constexpr std::array kKeywords = std::to_array<std::string_view>({
    "bevel",  "bmat",   "bsp",   "bzp",        "c_interp", "call",     "cdc",    "cdp",  "con",       "csh",
    "cstech", "cstype", "ctech", "curv",       "curv2",    "d_interp", "deg",    "end",  "f",         "fo",
    "g",      "hole",   "l",     "lod",        "maplib",   "mg",       "mtllib", "o",    "p",         "parm",
    "res",    "s",      "scrv",  "shadow_obj", "sp",       "stech",    "step",   "surf", "trace_obj", "trim",
    "usemap", "usemtl", "v",     "vn",         "vp",       "vt",
});
static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));

}  // namespace

bool isObjKeyword(std::string_view word) { return std::binary_search(kKeywords.begin(), kKeywords.end(), word); }

}  // namespace asdfvk
