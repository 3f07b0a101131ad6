// K06 section 3.2: one proxy, one membrane, in space.
#pragma once

#include <limits>

#include "punctura/model/vector3.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/exact_friction.hpp"

namespace punctura {

/// cos(80 degrees): a needle that enters flatter than that grazes, U = H / cos(beta) has no bound there, and it is given no
/// force (docs/errata.md, E6).
template <typename Scalar>
inline constexpr Scalar grazing_cosine = Scalar(0.17364817766693034885);

/// The proxy of K06 Fig. 7: it moves along b, the needle's direction at entry, and friction acts along b alone.
template <ObliqueLaw L>
class Proxy3d {
 public:
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;

  /// point: any point of the surface (a), m. inward_normal: n, of length 1.
  Proxy3d(const L& law, const Vector& point, const Vector& inward_normal, const BasicCoupling<Scalar>& coupling,
          Scalar period, Solver solver = Solver::exact) noexcept
      : law_(law), a_(point), n_(inward_normal), c_(coupling, period), solver_(solver) {}

  /// Forgets all motion. A proxy that starts inside stays barred until it has been outside, in front.
  void reset() noexcept {
    started_ = false;
    contact_ = Contact::barred;
    phase_ = Phase::barred;
    f_.setZero();
    e_.setZero();
    band_ = {0, 0};
    axial_force_ = 0;
  }

  /// Goes on from where another proxy is, under its own law and coupling. False, with nothing changed, where that one is
  /// at another membrane: a_ and n_ tell. Else it loses its place, so that no second proxy goes on from it.
  bool resume(Proxy3d& previous) noexcept {
    if (previous.a_ != a_ || previous.n_ != n_) return false;
    previous.a_ = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    started_ = previous.started_;
    contact_ = previous.contact_;
    phase_ = previous.phase_;
    p_ = previous.p_;
    e_ = previous.e_;
    f_ = previous.f_;
    b_ = previous.b_;
    cos_beta_ = previous.cos_beta_;
    if (contact_ == Contact::inside) law_.set_obliquity(cos_beta_);
    return true;
  }

  /// One tick: p (m), the device's position, and the needle's unit direction give the force on the device (N). K06 (41).
  const Vector& step(const Vector& p, const Vector& axis) noexcept {
    const Vector p_prev = started_ ? p_ : p;
    started_ = true;
    const Vector f_star = c_.holding_force(p, p_prev, e_);  // K06 (38)
    const Vector q_star = probe(p);

    // The exact solver leaves a membrane by its solution, below; everything else goes by q*.
    const bool in_front = n_.dot(q_star - a_) <= 0;
    if (in_front && !(solver_ == Solver::exact && contact_ == Contact::inside)) {
      contact_ = Contact::outside;
    } else if (contact_ == Contact::outside) {
      enter(axis);
    }

    phase_ = contact_ == Contact::barred ? Phase::barred : Phase::outside;
    if (contact_ == Contact::inside) rub(solver_ == Solver::paper ? q_star : Vector(p_prev + e_), f_star);
    if (contact_ == Contact::inside) {
      f_ = f_star + b_ * (axial_force_ - b_.dot(f_star));  // K06 (39)
      e_ = e_ - (p - p_prev) + c_.inv_g * (f_ - f_star);   // K06 (25) and (37), as in Proxy1d
    } else {
      f_.setZero();
      axial_force_ = 0;
      band_ = {0, 0};
      e_ = c_.relaxed(e_);  // K06 (25) with f = 0
      depth_ = n_.dot(p + e_ - a_);
    }
    p_ = p;
    return f_;
  }

  const L& law() const noexcept { return law_; }
  const Vector& force() const noexcept { return f_; }           ///< f(k), N
  const Vector& offset() const noexcept { return e_; }          ///< e(k) = q(k) - p(k), m
  Vector position() const noexcept { return p_ + e_; }          ///< q(k), m
  const Vector& direction() const noexcept { return b_; }       ///< b, held from entry on
  Scalar axial_force() const noexcept { return axial_force_; }  ///< b.f(k), N
  Phase phase() const noexcept { return phase_; }
  /// The band that bounds the axial force, N: taken at depth(), and 0 outside.
  const Band<Scalar>& band() const noexcept { return band_; }
  /// Along b while inside, m: of the proxy q(k), or of q*(k) with Solver::paper. Else along the normal, from the surface.
  Scalar depth() const noexcept { return depth_; }

 private:
  enum class Contact : std::uint8_t { outside, inside, barred };

  /// Where the tip is taken to be before the force is known: q* of K06 (40), or the free position (f = 0) when exact.
  Vector probe(const Vector& p) const noexcept {
    const Vector free = p + c_.B_over_D * e_;
    return solver_ == Solver::paper ? Vector(free + c_.inv_g * f_) : free;
  }

  /// The tip has just passed the surface: b and U are fixed until it leaves. K06 (41)
  void enter(const Vector& axis) noexcept {
    cos_beta_ = n_.dot(axis);
    if (!(cos_beta_ >= grazing_cosine<Scalar>)) {
      contact_ = Contact::barred;
      return;
    }
    contact_ = Contact::inside;
    b_ = axis;
    law_.set_obliquity(cos_beta_);
  }

  /// Friction along b, from q* (paper) or from the proxy's last place (exact). May find that the proxy leaves.
  void rub(const Vector& q, const Vector& f_star) noexcept {
    const Scalar s = n_.dot(q - a_) / cos_beta_;
    const Scalar f_star_b = b_.dot(f_star);
    Friction<Scalar> friction;
    if (solver_ == Solver::paper) {
      depth_ = s;
      band_ = law_.band(s);
      friction = clamped_friction(band_, f_star_b);
    } else {
      friction = exact_friction(law_, s, f_star_b, c_.g);
      depth_ = s + (friction.force - f_star_b) * c_.inv_g;  // K06 (37) along b
      band_ = law_.band(depth_);
      // With H = 0 the proxy may rest on the surface under load; without load it is out.
      if (depth_ <= 0 && friction.force == 0) {
        contact_ = Contact::outside;
        return;
      }
    }
    phase_ = friction.phase;
    axial_force_ = friction.force;
  }

  L law_;
  Vector a_, n_;
  SampledCoupling<Scalar> c_;
  Solver solver_;
  bool started_ = false;
  Contact contact_ = Contact::barred;
  Phase phase_ = Phase::barred;
  Vector p_ = Vector::Zero(), e_ = Vector::Zero(), f_ = Vector::Zero(), b_ = Vector::Zero();
  Scalar cos_beta_{1}, axial_force_{}, depth_{};
  Band<Scalar> band_{};
};

}  // namespace punctura
