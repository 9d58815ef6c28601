// 1 - exp(-x), the opacity of optical depth x >= 0; accurate for small x (the driver's exp is not).
float opacityOf(float x) {
  return x < 0.01 ? x * (1.0 - 0.5 * x * (1.0 - x * (1.0 / 3.0))) : 1.0 - exp(-x);
}
