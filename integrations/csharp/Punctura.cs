// Punctura in C#: scenes, insertions and the servo step. Thin: every force comes from the C library.
using System;
using System.Runtime.InteropServices;
using System.Text;

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

    /// <summary>A call failed. The message has one line for each problem, with the path of the value.</summary>
    public sealed class PuncturaException : Exception
    {
        public int Status { get; private set; }
        public PuncturaException(int status, string message) : base(message) { Status = status; }
    }

    internal static class Text
    {
        internal static byte[] C(string text) { return Encoding.UTF8.GetBytes(text + "\0"); }

        internal static string From(IntPtr text)
        {
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0) ++length;
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        internal static void Check(int status)
        {
            if (status == 0) return;
            // A tick keeps no text: the last error is then an older one.
            bool tick = status == (int)Status.NoPeek || status == (int)Status.NoNumber;
            string kept = tick ? "" : From(Native.punctura_last_error());
            throw new PuncturaException(status, kept.Length > 0 ? kept : From(Native.punctura_status_text(status)));
        }
    }

    /// <summary>A handle of the C library. A call keeps it alive; the finalizer frees it at the latest.</summary>
    public abstract class Handle : SafeHandle
    {
        protected Handle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
    }

    /// <summary>The numbers of a membrane, SI. Those without a default are NaN.</summary>
    public sealed class MembraneSettings
    {
        public string Name = "membrane";
        public double Stiffness = double.NaN, Precompression = double.NaN, Friction = double.NaN;
        public double Thickness = double.NaN;
        public Triple Point, InwardNormal = new Triple(0, -1, 0);
    }

    /// <summary>The description of a run.</summary>
    public sealed class Scene : Handle
    {
        Scene(IntPtr made) { SetHandle(made); }
        protected override bool ReleaseHandle() { Native.punctura_scene_free(handle); return true; }

        /// <summary>From the text of a scene file. Throws PuncturaException with all problems.</summary>
        public static Scene FromToml(string text) { return Made(Native.punctura_scene_from_toml, text); }
        /// <summary>From lines PATH = VALUE, in SI units.</summary>
        public static Scene FromValues(string text) { return Made(Native.punctura_scene_from_values, text); }

        /// <summary>A scene without membranes, SI.</summary>
        public Scene(string name, double diameter, double tipAngle, double stiffness, double damping)
        {
            CheckLibrary();
            Setup setup;
            Text.Check(Native.punctura_setup_init(out setup, (UIntPtr)Marshal.SizeOf(typeof(Setup))));
            setup.Diameter = diameter;
            setup.TipAngle = tipAngle;
            setup.Stiffness = stiffness;
            setup.Damping = damping;
            var pinned = GCHandle.Alloc(Text.C(name), GCHandleType.Pinned);
            try
            {
                setup.Name = pinned.AddrOfPinnedObject();
                IntPtr made;
                Text.Check(Native.punctura_scene_new(ref setup, out made));
                SetHandle(made);
            }
            finally { pinned.Free(); }
        }

        public void Add(MembraneSettings given)
        {
            Membrane membrane;
            Text.Check(Native.punctura_membrane_init(out membrane, (UIntPtr)Marshal.SizeOf(typeof(Membrane))));
            membrane.Stiffness = given.Stiffness;
            membrane.Precompression = given.Precompression;
            membrane.Friction = given.Friction;
            membrane.Thickness = given.Thickness;
            membrane.Point = given.Point;
            membrane.InwardNormal = given.InwardNormal;
            var pinned = GCHandle.Alloc(Text.C(given.Name), GCHandleType.Pinned);
            try
            {
                membrane.Name = pinned.AddrOfPinnedObject();
                Text.Check(Native.punctura_scene_add_membrane(this, ref membrane));
            }
            finally { pinned.Free(); }
        }

        /// <summary>A number by its path, SI, for example "membrane[0].friction".</summary>
        public double this[string path]
        {
            get
            {
                double value;
                Text.Check(Native.punctura_scene_get(this, Text.C(path), out value));
                return value;
            }
            set { Text.Check(Native.punctura_scene_set(this, Text.C(path), value)); }
        }

        /// <summary>Sets a word by its path, for example "servo.solver" to "paper".</summary>
        public void SetWord(string path, string word)
        {
            Text.Check(Native.punctura_scene_set_word(this, Text.C(path), Text.C(word)));
        }

        public int MembraneCount { get { return Native.punctura_scene_membrane_count(this); } }
        /// <summary>Numbers that are probably in a wrong unit, one line each; "" if there are none.</summary>
        public string Unusual() { return Text.From(Native.punctura_scene_unusual(this)); }
        /// <summary>Throws PuncturaException with all problems.</summary>
        public void Check() { Text.Check(Native.punctura_scene_check(this)); }

        delegate int Maker(byte[] text, UIntPtr size, out IntPtr scene);

        static Scene Made(Maker make, string text)
        {
            CheckLibrary();
            byte[] bytes = Encoding.UTF8.GetBytes(text);
            IntPtr made;
            Text.Check(make(bytes, (UIntPtr)bytes.Length, out made));
            return new Scene(made);
        }

        static void CheckLibrary()
        {
            if (Native.punctura_supports_abi(Native.Abi) == 1) return;
            string version = Text.From(Native.punctura_version());
            string text = "libpunctura " + version + " does not fit this binding: take both from one version";
            throw new PuncturaException(1, text);
        }
    }

    /// <summary>The model of a scene. Its force is the model's, without limits.</summary>
    public sealed class Insertion : Handle
    {
        public Insertion(Scene scene)
        {
            IntPtr made;
            Text.Check(Native.punctura_insertion_new(scene, out made));
            SetHandle(made);
        }
        protected override bool ReleaseHandle() { Native.punctura_insertion_free(handle); return true; }

        /// <summary>One tick. position: m. axis: of any length but 0. Returns N; NaN for what is not finite.</summary>
        public Triple Step(Triple position, Triple axis)
        {
            Triple force;
            Native.punctura_insertion_step(this, ref position, ref axis, out force);
            return force;
        }
        /// <summary>The force that Step would give. Changes nothing until Commit.</summary>
        public Triple Peek(Triple position, Triple axis)
        {
            Triple force;
            Native.punctura_insertion_peek(this, ref position, ref axis, out force);
            return force;
        }
        public void Commit() { Text.Check(Native.punctura_insertion_commit(this)); }
        public void Reset() { Text.Check(Native.punctura_insertion_reset(this)); }

        public MembraneTick Membrane(int i)
        {
            var tick = new MembraneTick { StructSize = (UIntPtr)Marshal.SizeOf(typeof(MembraneTick)) };
            Text.Check(Native.punctura_insertion_membrane(this, i, ref tick));
            return tick;
        }

        /// <summary>The complete state. Setting it continues with the same bits.</summary>
        public byte[] State
        {
            get
            {
                var bytes = new byte[(int)Native.punctura_insertion_state_size(this)];
                Text.Check(Native.punctura_insertion_save(this, bytes, (UIntPtr)bytes.Length));
                return bytes;
            }
            set { Text.Check(Native.punctura_insertion_restore(this, value, (UIntPtr)value.Length)); }
        }
    }

    public partial struct Sample
    {
        /// <summary>A sample without fault, at the origin, with the axis (0, -1, 0).</summary>
        public static Sample Healthy()
        {
            Sample sample;
            Native.punctura_sample_init(out sample, (UIntPtr)Marshal.SizeOf(typeof(Sample)));
            return sample;
        }
    }

    /// <summary>The whole tick for a device, with gate and force limits (docs/safety.md). Default limits.</summary>
    public sealed class Servo : Handle
    {
        public Servo(Scene scene)
        {
            IntPtr made;
            Text.Check(Native.punctura_servo_new(scene, IntPtr.Zero, out made));
            SetHandle(made);
        }
        protected override bool ReleaseHandle() { Native.punctura_servo_free(handle); return true; }

        public void Arm() { Text.Check(Native.punctura_servo_arm(this)); }
        public void Disarm() { Text.Check(Native.punctura_servo_disarm(this)); }
        public void Reset() { Text.Check(Native.punctura_servo_reset(this)); }

        public Record Step(Sample sample)
        {
            var record = new Record { StructSize = (UIntPtr)Marshal.SizeOf(typeof(Record)) };
            Text.Check(Native.punctura_servo_step(this, ref sample, ref record));
            return record;
        }
        public static string FaultText(int fault) { return Text.From(Native.punctura_fault_text(fault)); }
    }
}
