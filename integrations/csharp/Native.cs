// The functions of punctura.h that the binding uses. docs/c-abi.md explains them.
using System;
using System.Runtime.InteropServices;

namespace Punctura
{
    /// <summary>Three numbers: a position in m, a direction or a force in N.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Triple
    {
        public double X, Y, Z;
        public Triple(double x, double y, double z) { X = x; Y = y; Z = z; }
        public double Length { get { return Math.Sqrt(X * X + Y * Y + Z * Z); } }
        public override string ToString() { return "(" + X + ", " + Y + ", " + Z + ")"; }
    }

    /// <summary>One membrane in a tick: punctura_membrane_tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MembraneTick
    {
        internal UIntPtr StructSize;
        public Phase Phase;
        public double Depth, AxialForce, Lower, Upper;
        public Triple Proxy, Direction;
    }

    public enum Phase { Outside, Sticking, SlidingIn, SlidingOut, Barred }
    public enum ServoState { Disarmed, Waiting, Active, Faulted }

    /// <summary>The reading of a device in a tick: punctura_sample. Make it with Sample.Healthy().</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Sample
    {
        internal UIntPtr StructSize;
        public ulong Sequence;
        public double Time;
        public Triple Position, Axis;
        public uint Buttons;
        public int IsHealthy;
        public double MotorTemperature, Thumb;

        public static Sample Healthy()
        {
            Sample sample;
            Native.punctura_sample_init(out sample, (UIntPtr)Marshal.SizeOf(typeof(Sample)));
            return sample;
        }
    }

    /// <summary>The record of a tick: punctura_record.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Record
    {
        internal UIntPtr StructSize;
        public ulong Tick;
        public ServoState State;
        public int Fault, Limit;
        public uint MembraneCount;
        public Triple Tip, ModelForce, Force;
        public double ForceScale, Ceiling, ThumbForce, Plunger, PlungerForce, Pressure, Left;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct SetupStruct
    {
        internal UIntPtr StructSize;
        internal IntPtr Name;
        internal double Diameter, TipAngle, Stiffness, Damping, Rate, LowPass;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct MembraneStruct
    {
        internal UIntPtr StructSize;
        internal IntPtr Name;
        internal double Stiffness, Precompression, Friction, Thickness;
        internal Triple Point, InwardNormal;
    }

    internal static class Native
    {
        internal const int Abi = 1, NoPeek = 4, NoNumber = 5;
        const string Library = "punctura";
        const CallingConvention C = CallingConvention.Cdecl;

        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_supports_abi(int abi);
        [DllImport(Library, CallingConvention = C)]
        internal static extern IntPtr punctura_version();
        [DllImport(Library, CallingConvention = C)]
        internal static extern IntPtr punctura_last_error();
        [DllImport(Library, CallingConvention = C)]
        internal static extern IntPtr punctura_status_text(int status);
        [DllImport(Library, CallingConvention = C)]
        internal static extern IntPtr punctura_fault_text(int fault);

        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_from_toml(byte[] text, UIntPtr size, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_from_values(byte[] text, UIntPtr size, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_setup_init(out SetupStruct setup, UIntPtr size);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_membrane_init(out MembraneStruct membrane, UIntPtr size);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_new(ref SetupStruct setup, out IntPtr scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_add_membrane(Scene scene, ref MembraneStruct membrane);
        [DllImport(Library, CallingConvention = C)]
        internal static extern void punctura_scene_free(IntPtr scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_set(Scene scene, byte[] path, double value);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_get(Scene scene, byte[] path, out double value);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_set_word(Scene scene, byte[] path, byte[] word);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_membrane_count(Scene scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_scene_check(Scene scene);
        [DllImport(Library, CallingConvention = C)]
        internal static extern IntPtr punctura_scene_unusual(Scene scene);

        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_new(Scene scene, out IntPtr insertion);
        [DllImport(Library, CallingConvention = C)]
        internal static extern void punctura_insertion_free(IntPtr insertion);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_reset(Insertion insertion);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_step(Insertion insertion, ref Triple position, ref Triple axis,
            out Triple force);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_peek(Insertion insertion, ref Triple position, ref Triple axis,
            out Triple force);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_commit(Insertion insertion);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_membrane(Insertion insertion, int membrane,
            ref MembraneTick tick);
        [DllImport(Library, CallingConvention = C)]
        internal static extern UIntPtr punctura_insertion_state_size(Insertion insertion);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_save(Insertion insertion, byte[] state, UIntPtr size);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_insertion_restore(Insertion insertion, byte[] state, UIntPtr size);

        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_sample_init(out Sample sample, UIntPtr size);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_servo_new(Scene scene, IntPtr limits, out IntPtr servo);
        [DllImport(Library, CallingConvention = C)]
        internal static extern void punctura_servo_free(IntPtr servo);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_servo_arm(Servo servo);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_servo_disarm(Servo servo);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_servo_reset(Servo servo);
        [DllImport(Library, CallingConvention = C)]
        internal static extern int punctura_servo_step(Servo servo, ref Sample sample, ref Record record);
    }
}
