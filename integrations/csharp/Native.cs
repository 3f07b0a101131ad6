// Made by tools/make_c_bindings.py, from punctura.h.
using System;
using System.Runtime.InteropServices;

namespace Punctura
{
    internal enum Status { Ok, BadArgument, BadScene, BadState, NoPeek, NoNumber, NoMemory, NotBuilt, Internal }
    public enum Phase { Outside, Sticking, SlidingIn, SlidingOut, Barred }
    public enum ServoState { Disarmed, Waiting, Active, Faulted }
    public enum Limit { None, Ramp, Peak, Continuous, Temperature }

    /// <summary>From structs. The _init functions set the numbers without default to NaN and all others to their default. Call them as punctura_setup_init(&setup, sizeof setup).</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal partial struct Setup
    {
        internal UIntPtr StructSize;
        internal IntPtr Name;
        internal double Diameter, TipAngle;  // m, rad
        internal double Stiffness, Damping;  // of the virtual coupling, N/m, N s/m
        internal double Rate;  // Hz
        internal double LowPass;  // Hz; 0 is off
    }

    [StructLayout(LayoutKind.Sequential)]
    internal partial struct Membrane
    {
        internal UIntPtr StructSize;
        internal IntPtr Name;
        internal double Stiffness, Precompression, Friction, Thickness;  // N/m, N, -, m
        internal Triple Point, InwardNormal;  // m, a direction of any length but 0
    }

    /// <summary>One membrane in a tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct MembraneTick
    {
        internal UIntPtr StructSize;
        public Phase Phase;
        public double Depth;  // m, of the band
        public double AxialForce;  // N, along the needle
        public double Lower, Upper;  // the band, N
        public Triple Proxy;  // m
        public Triple Direction;  // of the needle at entry, valid while inside
    }

    /// <summary>The reading of the device in a tick. punctura_sample_init() gives a healthy sample with the axis (0, -1, 0).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Sample
    {
        internal UIntPtr StructSize;
        public ulong Sequence;  // number of the reading: an equal number is the same reading
        public double Time;  // start of the tick, s, on a clock that never goes back, and goes on while the computer sleeps: on Linux CLOCK_BOOTTIME
        public Triple Position;  // of the tip, m
        public Triple Axis;  // direction of the needle, of length 1
        public uint Buttons;  // one bit for each button
        public int IsHealthy;  // 0: the device reports a fault
        public double MotorTemperature;  // 1 is the maker's danger limit; 0 if it is not reported
        public double Thumb;  // depth of the thumb on the plunger, m
    }

    /// <summary>The record of a tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Record
    {
        internal UIntPtr StructSize;
        public ulong Tick;
        public ServoState State;
        public int Fault;  // 0: none. punctura_fault_text() says what to do
        public Limit Limit;
        public uint MembraneCount;
        public Triple Tip;  // the conditioned position, m
        public Triple ModelForce;  // N, without scale and limits
        public Triple Force;  // N, for the device
        public double ForceScale;
        public double Ceiling;  // the largest force that all limits permit in this tick, N
        public double ThumbForce;  // N, for the device under the thumb, before its own limits
        public double Plunger, PlungerForce, Pressure, Left;  // m, N, Pa, m^3; NaN without a syringe
    }

    internal static class Native
    {
        internal const int Abi = 1;
        const string Library = "punctura";
        const CallingConvention C = CallingConvention.Cdecl;
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr punctura_version();
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_supports_abi(int abi);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr punctura_status_text(int status);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr punctura_last_error();
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_from_toml(byte[] text, UIntPtr size, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_from_values(byte[] text, UIntPtr size, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_setup_init(out Setup setup, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_membrane_init(out Membrane membrane, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_new(ref Setup setup, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_add_membrane(Scene scene, ref Membrane membrane);
        [DllImport(Library, CallingConvention = C)] internal static extern void punctura_scene_free(IntPtr scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_set(Scene scene, byte[] path, double value);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_get(Scene scene, byte[] path, out double value);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_set_word(Scene scene, byte[] path, byte[] word);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_membrane_count(Scene scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_scene_check(Scene scene);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr punctura_scene_unusual(Scene scene);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_new(Scene scene, out IntPtr insertion);
        [DllImport(Library, CallingConvention = C)] internal static extern void punctura_insertion_free(IntPtr insertion);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_reset(Insertion insertion);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_step(Insertion insertion, ref Triple position, ref Triple axis, out Triple force);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_peek(Insertion insertion, ref Triple position, ref Triple axis, out Triple force);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_commit(Insertion insertion);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_membrane(Insertion insertion, int membrane, ref MembraneTick tick);
        [DllImport(Library, CallingConvention = C)] internal static extern UIntPtr punctura_insertion_state_size(Insertion insertion);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_save(Insertion insertion, byte[] state, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_insertion_restore(Insertion insertion, byte[] state, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_sample_init(out Sample sample, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr punctura_fault_text(int fault);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_servo_new(Scene scene, IntPtr limits, out IntPtr servo);
        [DllImport(Library, CallingConvention = C)] internal static extern void punctura_servo_free(IntPtr servo);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_servo_arm(Servo servo);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_servo_disarm(Servo servo);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_servo_reset(Servo servo);
        [DllImport(Library, CallingConvention = C)] internal static extern int punctura_servo_step(Servo servo, ref Sample sample, ref Record record);
    }
}
