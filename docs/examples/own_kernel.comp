#version 450
// Squares each number of a buffer.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Numbers { float numbers[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) numbers[i] *= numbers[i];
}
