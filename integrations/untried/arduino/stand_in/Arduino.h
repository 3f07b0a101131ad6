// A stand-in for Arduino.h with the functions that the sketch calls, and the macros of older cores.
#pragma once
void analogWrite(int pin, int value);
void digitalWrite(int pin, int value);
void pinMode(int pin, int mode);
int analogRead(int pin);
unsigned long micros();
inline constexpr int OUTPUT = 1, A0 = 14;
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x) - 0.5))
