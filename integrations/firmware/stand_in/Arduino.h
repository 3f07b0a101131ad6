// A stand-in for Arduino.h with the functions that the sketch calls.
#pragma once
void analogWrite(int pin, int value);
void digitalWrite(int pin, int value);
void pinMode(int pin, int mode);
int analogRead(int pin);
unsigned long micros();
inline constexpr int OUTPUT = 1, A0 = 14;
