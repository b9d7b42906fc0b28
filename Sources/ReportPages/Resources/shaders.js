// Own shaders write the bytes of sRGB directly. So both revisions of the library (r111 and r180)
// show the same colors, although they differ in color management, vertex colors and lights.

/** How the surface is colored; the numbers are known to `SURFACE_FRAGMENT`. */
const SURFACE_MODES = { texture: 0, colors: 1, heat: 2, closed: 3, shape: 4 };

const SURFACE_VERTEX = `
attribute vec3 tint;
attribute float value;
uniform vec2 coordinateOrigin;
uniform vec2 coordinateSize;
varying vec2 vCoordinate;
varying vec3 vTint;
varying vec3 vNormal;
varying vec2 vValue;
void main() {
  vCoordinate = coordinateOrigin + coordinateSize * uv;
  vTint = tint;
  // 255 is "no data": a weight keeps it out of the interpolation over a triangle.
  vValue = value > 254.5 ? vec2(0.0) : vec2(value, 1.0);
  vNormal = normalMatrix * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const HEAT = `
uniform sampler2D ramp;
vec4 heat(vec2 value, vec3 noData) {
  if (value.y < 0.5) return vec4(noData, 0.0);
  float share = value.x / value.y / 254.0;
  return vec4(texture2D(ramp, vec2(share * 0.996 + 0.002, 0.5)).rgb, 1.0);
}`;

const SURFACE_FRAGMENT = `
uniform float mode;
uniform sampler2D picture;
uniform vec3 noData;
uniform vec3 closedColor;
uniform vec3 shownColor;
varying vec2 vCoordinate;
varying vec3 vTint;
varying vec3 vNormal;
varying vec2 vValue;
${HEAT}
void main() {
  vec3 normal = normalize(gl_FrontFacing ? vNormal : -vNormal);
  float light = 0.45 + 0.6 * max(dot(normal, normalize(vec3(-0.35, 0.55, 0.75))), 0.0);
  vec3 color = vec3(0.82, 0.81, 0.79);
  float shade = 1.0;
  if (mode < 0.5) { color = texture2D(picture, vCoordinate).rgb; shade = 0.0; }
  else if (mode < 1.5) { color = vTint; shade = 0.0; }
  else if (mode < 2.5) { color = heat(vValue, noData).rgb; shade = 0.5; }
  else if (mode < 3.5) { color = vValue.x > 127.0 ? closedColor : shownColor; shade = 0.6; }
  gl_FragColor = vec4(color * mix(1.0, light, shade), 1.0);
}`;

const POINT_VERTEX = `
attribute vec3 tint;
uniform float size;
varying vec3 vTint;
void main() {
  vTint = tint;
  gl_PointSize = size;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const LINE_VERTEX = `
attribute vec4 tint;
varying vec4 vTint;
void main() {
  vTint = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const POINT_FRAGMENT = `
varying vec3 vTint;
void main() { gl_FragColor = vec4(vTint, 1.0); }`;

const LINE_FRAGMENT = `
varying vec4 vTint;
void main() { gl_FragColor = vTint; }`;

const PLANE_VERTEX = `
varying vec2 vCoordinate;
varying float vOpacity;
void main() {
  vCoordinate = uv;
  // How much the photo looks where the viewer looks: 1 if it covers what it shows.
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  float covering = dot(normalize(normalMatrix * normal), normalize(place.xyz));
  vOpacity = mix(1.0, 0.1, smoothstep(0.2, 0.9, covering));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/** A photo between the viewer and the object must not hide the object: it is nearly transparent. */
const PLANE_FRAGMENT = `
uniform sampler2D atlas;
varying vec2 vCoordinate;
varying float vOpacity;
void main() {
  gl_FragColor = vec4(texture2D(atlas, vCoordinate).rgb, vOpacity);
}`;

/** Projects the model into a photo, through the camera's whole distortion model (as OpenCV's). */
const PROJECTION_VERTEX = `
attribute float value;
uniform mat4 cameraFromModel;
uniform vec2 focalLength;
uniform vec2 principalPoint;
uniform vec4 distortion;
uniform float maximumRadius;
uniform vec2 imageSize;
uniform vec2 depthRange;
varying vec2 vValue;
void main() {
  vValue = value > 254.5 ? vec2(0.0) : vec2(value, 1.0);
  vec3 p = (cameraFromModel * vec4(position, 1.0)).xyz;
  vec2 q = p.xy / p.z;
  float r2 = dot(q, q);
  // Behind the camera, or where the polynomial folds back into the picture.
  if (p.z <= 0.0 || r2 > maximumRadius * maximumRadius) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  vec2 distorted = q * (1.0 + r2 * (distortion.x + r2 * distortion.y))
    + vec2(2.0 * distortion.z * q.x * q.y + distortion.w * (r2 + 2.0 * q.x * q.x),
           2.0 * distortion.w * q.x * q.y + distortion.z * (r2 + 2.0 * q.y * q.y));
  vec2 pixel = focalLength * distorted + principalPoint;
  vec2 place = 2.0 * pixel / imageSize - 1.0;
  float near = depthRange.x;
  float far = depthRange.y;
  float depth = (far + near) / (far - near) - 2.0 * far * near / ((far - near) * p.z);
  gl_Position = vec4(place * p.z, depth * p.z, p.z);
}`;

const PROJECTION_FRAGMENT = `
uniform vec3 noData;
uniform float isClosedMap;
uniform vec3 closedColor;
uniform vec3 shownColor;
varying vec2 vValue;
${HEAT}
void main() {
  vec3 color = heat(vValue, noData).rgb;
  if (isClosedMap > 0.5) color = vValue.x > 127.0 ? closedColor : shownColor;
  gl_FragColor = vec4(color, 1.0);
}`;
