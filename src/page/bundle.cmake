# Bundles the sources of the page into two C++ strings, the page and its script:
#   cmake -DPAGE=src/page/browser -DOUTPUT=page_template.cpp -P bundle.cmake
# The script is one function with the shaders (NAME.glsl is shaders.NAME) and the modules, in the order of
# PAGE/modules.txt. Imports (one line each), the word `export`, comment lines and leading blanks are removed. All
# top-level names of the modules must therefore differ. This script fills the places @CSP@, @STYLE@ and @LOADER@ of
# page.html. src/page/page.cpp fills the other places and compresses the script; loader.js decompresses the script.
cmake_minimum_required(VERSION 3.25)

function(asdfvk_shortened text result)
  set(text "\n${text}\n")
  string(REGEX REPLACE "\n[ \t]*/\\*([^*]|\\*+[^*/])*\\*+/[ \t]*\n" "\n" text "${text}")
  string(REGEX REPLACE "\n[ \t]*//[^\n]*" "\n" text "${text}")
  string(REGEX REPLACE "\n[ \t]+" "\n" text "${text}")
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  string(REGEX REPLACE "^\n" "" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# The SHA-256 of a text in base64, for a content-security policy.
function(asdfvk_policy_hash text result)
  string(SHA256 hex "${text}")
  set(digits "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  set(base64 "")
  foreach(at RANGE 0 60 6)
    string(SUBSTRING "${hex}00" ${at} 6 group)
    math(EXPR number "0x${group}")
    foreach(shift 18 12 6 0)
      math(EXPR digit "(${number} >> ${shift}) & 63")
      string(SUBSTRING "${digits}" ${digit} 1 digit)
      string(APPEND base64 "${digit}")
    endforeach()
  endforeach()
  string(SUBSTRING "${base64}" 0 43 base64)  # 32 bytes; the rest is padding.
  set(${result} "'sha256-${base64}='" PARENT_SCOPE)
endfunction()

function(asdfvk_refuse text pattern reason)
  if("${text}" MATCHES "${pattern}")
    message(FATAL_ERROR "${reason}")
  endif()
endfunction()

set(script "const shaders = {\n")
file(GLOB shaders ${PAGE}/*.glsl)
foreach(shader IN LISTS shaders)
  file(READ ${shader} text)
  asdfvk_refuse("${text}" "[`\\$]" "${shader}: a shader may have no backquote, backslash or dollar sign")
  asdfvk_shortened("${text}" text)
  get_filename_component(name ${shader} NAME_WE)
  string(APPEND script "${name}: `${text}`,\n")
endforeach()
string(APPEND script "};\n")

file(STRINGS ${PAGE}/modules.txt modules REGEX "^[a-z]")
foreach(module IN LISTS modules)
  file(READ ${PAGE}/${module} text)
  asdfvk_shortened("${text}" text)
  set(text "\n${text}")
  string(REGEX REPLACE "\nimport [^\n]*" "" text "${text}")
  asdfvk_refuse("${text}" "\n(export [{*d]|import)" "${module}: only `export` before a declaration, and imports of one line")
  string(REPLACE "\nexport " "\n" text "${text}")
  string(REGEX REPLACE "^\n" "" text "${text}")
  string(APPEND script "${text}")
endforeach()
set(script "(()=>{'use strict';\n${script}})();")
asdfvk_refuse("${script}" "</[sS][cC][rR]|<!--" "the script contains </script or <!--, which end it or hide it")

file(READ ${PAGE}/loader.js loader)
asdfvk_shortened("${loader}" loader)
asdfvk_policy_hash("${loader}" loaderHash)
file(READ ${PAGE}/page.css style)
asdfvk_shortened("${style}" style)
asdfvk_policy_hash("${script}" scriptHash)
asdfvk_policy_hash("${style}" styleHash)
set(policy "default-src 'none'; script-src ${loaderHash} ${scriptHash}; style-src ${styleHash}; img-src data: blob:")
string(APPEND policy "; base-uri 'none'; form-action 'none'")

file(READ ${PAGE}/page.html page)
string(REGEX REPLACE "\n[ \t]+" "\n" page "${page}")
foreach(place TITLE CSP STYLE SCRIPT LOADER DATA FALLBACK)
  if(NOT "${page}" MATCHES "@${place}@")
    message(FATAL_ERROR "page.html has no place @${place}@")
  endif()
endforeach()
string(REPLACE "@CSP@" "${policy}" page "${page}")
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@LOADER@" "${loader}" page "${page}")
asdfvk_refuse("${page}${script}" "[)]asdfvk\"" "the page ends the C++ string")
file(WRITE ${OUTPUT} "// Written by src/page/bundle.cmake.\n#include \"page/page_template.h\"\n\n"
     "#pragma GCC diagnostic ignored \"-Woverlength-strings\"  // Clang warns above 65,536 characters.\n\n"
     "namespace asdfvk {\n\nconst std::string_view kPageTemplate = R\"asdfvk(${page})asdfvk\";\n"
     "const std::string_view kPageScript = R\"asdfvk(${script})asdfvk\";\n\n}  // namespace asdfvk\n")
