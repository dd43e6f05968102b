# Writes the text of a file into a C++ function:
#   cmake -DTEXT=docs/schema.json -DOUTPUT=schema_text.cpp -P schema.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${TEXT} text)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "serve/json_schema.h"

std::string_view asdfvk::schemaText() {
  return R"SCHEMA(@text@)SCHEMA";
}
]])
