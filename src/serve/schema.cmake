# Writes the text of a file into a C++ function:
#   cmake -DTEXT=docs/schema.json -DOUTPUT=schema_text.cpp -P schema.cmake
# The text is in pieces, because C++ compilers need not support literals of more than 65,536 bytes.
cmake_minimum_required(VERSION 3.25)

file(READ ${TEXT} text)
string(LENGTH "${text}" length)
set(pieces "")
foreach(begin RANGE 0 ${length} 60000)
  string(SUBSTRING "${text}" ${begin} 60000 piece)
  string(APPEND pieces "\n      .append(R\"SCHEMA(${piece})SCHEMA\")")
endforeach()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "serve/json_schema.h"

std::string_view asdfvk::schemaText() {
  static const std::string text = std::string()@pieces@;
  return text;
}
]])
