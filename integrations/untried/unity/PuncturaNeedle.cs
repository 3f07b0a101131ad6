// Never run in Unity: a needle in a Unity scene. Put it on the needle's object. The tip is at the transform's position,
// and the needle points along the transform's forward axis.
//
// The membranes are those of a scene file, or all PuncturaMembrane of the scene at the start.
using UnityEngine;

namespace Punctura
{
    public sealed class PuncturaNeedle : MonoBehaviour
    {
        [Tooltip("Text of a scene file. Empty: the numbers below and all membranes of the scene.")]
        public TextAsset sceneFile;
        [Tooltip("w, mm")] public float diameter = 1.08f;
        [Tooltip("theta, degrees")] public float tipAngle = 16f;
        [Tooltip("K, N/mm")] public float couplingStiffness = 0.4f;
        [Tooltip("B, N s/mm")] public float couplingDamping = 0.001f;
        [Tooltip("Gets the force at the tip in each physics step, if it is set.")] public Rigidbody body;
        [Tooltip("Shows the force on the screen.")] public bool showForce = true;

        /// <summary>The model's force on the needle after the last physics step, N, in Unity's axes.</summary>
        public Vector3 Force { get; private set; }
        /// <summary>The same in double precision and in Punctura's axes.</summary>
        public Triple ExactForce { get; private set; }
        public Insertion Insertion { get; private set; }

        Triple lastPosition, lastAxis;
        double rate, due;
        bool started;

        void OnEnable()
        {
            using (Scene scene = MakeScene())
            {
                rate = scene["servo.rate"];
                Insertion = new Insertion(scene);
            }
            started = false;
            due = 0;
        }

        void OnDisable()
        {
            if (Insertion != null) Insertion.Dispose();
            Insertion = null;
        }

        Scene MakeScene()
        {
            if (sceneFile != null) return Scene.FromToml(sceneFile.text);
            var scene = new Scene(name, diameter * 1e-3, tipAngle * System.Math.PI / 180, couplingStiffness * 1e3,
                                  couplingDamping * 1e3);
            foreach (PuncturaMembrane membrane in FindObjectsOfType<PuncturaMembrane>()) scene.Add(membrane.Settings());
            return scene;
        }

        /// <summary>Makes all ticks of a physics step. The tip moves in a straight line from its last place.</summary>
        void FixedUpdate()
        {
            Triple position = Axes.ToPunctura(transform.position), axis = Axes.ToPunctura(transform.forward);
            if (!started)
            {
                lastPosition = position;
                lastAxis = axis;
                started = true;
            }
            due += Time.fixedDeltaTime * rate;
            int ticks = (int)System.Math.Floor(due + 1e-6);
            due -= ticks;
            for (int i = 1; i <= ticks; ++i)
            {
                double share = (double)i / ticks;
                ExactForce = Insertion.Step(Between(lastPosition, position, share), Between(lastAxis, axis, share));
            }
            lastPosition = position;
            lastAxis = axis;
            Force = Axes.ToUnity(ExactForce);
            bool number = ExactForce.X == ExactForce.X;  // not after a position that is not finite
            if (body != null && number) body.AddForceAtPosition(Force, transform.position);
        }

        static Triple Between(Triple a, Triple b, double share)
        {
            if (share == 1) return b;  // with all its bits
            return new Triple(a.X + (b.X - a.X) * share, a.Y + (b.Y - a.Y) * share, a.Z + (b.Z - a.Z) * share);
        }

        void OnGUI()
        {
            if (!showForce || Insertion == null) return;
            GUI.Label(new Rect(10, 10, 400, 25), name + ": " + Force.magnitude.ToString("0.00") + " N");
        }
    }
}
